#include "lv/mesh_io/vtk_fibres.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/printable.hpp"
#include "lv/mesh_io/vtk_grid.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace lv::mesh_io {
namespace {

using At = mesh::GivenFibres::At;

constexpr const char* usual_name = "FIB_DIR";  // SimVascular's

/// Vectors at the volume cells of a grid, or at its points.
struct Directions {
  At at = At::cells;
  std::vector<Vec3> vectors;
};

bool is_volume(vtkUnstructuredGrid& grid, vtkIdType cell) {
  return shape_of(grid.GetCellType(cell)).dimension == 3;
}

Vec3 vector_at(vtkDataArray& array, vtkIdType i) {
  return {array.GetComponent(i, 0), array.GetComponent(i, 1), array.GetComponent(i, 2)};
}

std::vector<std::string> vector_names(vtkUnstructuredGrid& grid) {
  std::vector<std::string> names;
  for (vtkFieldData* data :
       std::initializer_list<vtkFieldData*>{grid.GetCellData(), grid.GetPointData()})
    for (const std::string& name : array_names(*data))
      if (const vtkDataArray* array = data->GetArray(name.c_str());
          array != nullptr && array->GetNumberOfComponents() == 3)
        names.push_back(name);
  return names;
}

Directions read_array(const std::string& file, vtkUnstructuredGrid& grid, const std::string& name) {
  const bool in_cells = grid.GetCellData()->HasArray(name.c_str()) != 0;
  const bool at_points = grid.GetPointData()->HasArray(name.c_str()) != 0;
  if (!in_cells && !at_points && vector_names(grid).empty())
    throw InputError(file, fmt::format("has no arrays of vectors, so no fibres \"{}\"", name),
                     "Name a .vtu file with the same cells and such an array, or leave them to the "
                     "rule of [fibres]");
  if (!in_cells && !at_points)
    fail_missing_tag(file, "array of vectors", name, vector_names(grid));
  if (in_cells && at_points)
    throw InputError(file, fmt::format("has a cell array and a point array \"{}\"", name),
                     "Rename one of them");
  Directions directions{in_cells ? At::cells : At::nodes, {}};
  vtkDataArray& array = in_cells ? find_array(file, *grid.GetCellData(), grid.GetNumberOfCells(), 3,
                                              "cell array", name)
                                 : find_array(file, *grid.GetPointData(), grid.GetNumberOfPoints(),
                                              3, "point array", name);
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
    if (!in_cells || is_volume(grid, i))
      directions.vectors.push_back(vector_at(array, i));
  return directions;
}

/// Throws unless two grids have the same points and cells, in the same order.
void check_same(const std::string& file, vtkUnstructuredGrid& grid, const std::string& mesh_file,
                vtkUnstructuredGrid& mesh) {
  const auto fail = [&](const std::string& what) {
    throw InputError(file, fmt::format("is not of the mesh {}: {}", mesh_file, what),
                     "Take the file of fibres that was made for this mesh");
  };
  if (grid.GetNumberOfCells() != mesh.GetNumberOfCells() ||
      grid.GetNumberOfPoints() != mesh.GetNumberOfPoints())
    fail(fmt::format("it has {} cells and {} points instead of {} and {}", grid.GetNumberOfCells(),
                     grid.GetNumberOfPoints(), mesh.GetNumberOfCells(), mesh.GetNumberOfPoints()));
  const double tolerance = 1e-5 * mesh.GetLength();
  for (vtkIdType p = 0; p < mesh.GetNumberOfPoints(); ++p)
    if (!((Vec3(grid.GetPoint(p)) - Vec3(mesh.GetPoint(p))).norm() <= tolerance))
      fail(fmt::format("point {} lies elsewhere", p));
  vtkNew<vtkIdList> own;
  vtkNew<vtkIdList> other;
  for (vtkIdType c = 0; c < mesh.GetNumberOfCells(); ++c) {
    grid.GetCellPoints(c, own);
    mesh.GetCellPoints(c, other);
    if (!std::equal(own->begin(), own->end(), other->begin(), other->end()))
      fail(fmt::format("cell {} has other points", c));
  }
}

/// The array of fibres in a file of its own.
std::string array_in(const std::string& file, vtkUnstructuredGrid& grid) {
  const std::vector<std::string> names = vector_names(grid);
  if (std::find(names.begin(), names.end(), usual_name) != names.end())
    return usual_name;
  if (names.size() != 1)
    throw InputError(file,
                     fmt::format("has {} arrays of vectors{}{}, none of them {}", names.size(),
                                 names.empty() ? "" : ": ", fmt::join(names, ", "), usual_name),
                     fmt::format("Write the directions as the cell array {}", usual_name));
  return names.front();
}

/// From the array of that name, or the file.
Directions read_directions(const mesh::ImportParameters& parameters, vtkUnstructuredGrid& grid,
                           const std::string& name) {
  if (!names_file(name))
    return read_array(parameters.file, grid, name);
  const auto other = read_grid(name);
  check_same(name, *other, parameters.file, grid);
  return read_array(name, *other, array_in(name, *other));
}

/// Whether the vectors of an array have unit length, but for a few.
bool has_unit_length(vtkDataArray& array) {
  vtkIdType unit = 0;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
    unit += std::abs(vector_at(array, i).norm() - 1.0) < 0.01 ? 1 : 0;
  return array.GetNumberOfTuples() > 0 && 10 * unit >= 9 * array.GetNumberOfTuples();
}

bool is_fibre_name(const std::string& called) {
  const std::string name = lower_case(called);
  constexpr std::array<std::string_view, 4> whole{"f", "f0", "s", "s0"};
  constexpr std::array<std::string_view, 3> parts{"fib", "sheet", "lon"};
  return std::find(whole.begin(), whole.end(), name) != whole.end() ||
         std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return name.starts_with(part); });
}

/// The arrays of a grid that may be fibres or sheets, by what they hold or are called.
std::vector<std::string> likely_fibres(vtkUnstructuredGrid& grid) {
  std::vector<std::string> likely;
  for (vtkFieldData* data :
       std::initializer_list<vtkFieldData*>{grid.GetCellData(), grid.GetPointData()})
    for (const std::string& name : array_names(*data)) {
      vtkDataArray* array = data->GetArray(name.c_str());
      if (array == nullptr || array->GetNumberOfComponents() % 3 != 0 || name == "Normals")
        continue;
      if (is_fibre_name(name) || (array->GetNumberOfComponents() == 3 && has_unit_length(*array)))
        likely.push_back(printable(name));
    }
  return likely;
}

void note_likely(vtkUnstructuredGrid& grid, ForeignMesh& foreign) {
  if (const auto likely = likely_fibres(grid); !likely.empty())
    foreign.notes.push_back(
        fmt::format("the file has what may be fibres ({}), which are not used: fibres follow the "
                    "rule of [fibres] unless anatomy.mesh.fibres names them",
                    fmt::join(likely, ", ")));
}

}  // namespace

void read_vtk_fibres(const mesh::ImportParameters& parameters, vtkUnstructuredGrid& grid,
                     ForeignMesh& foreign) {
  if (parameters.fibres.empty()) {
    note_likely(grid, foreign);
    return;
  }
  Directions fibres = read_directions(parameters, grid, parameters.fibres);
  Directions sheets;
  if (!parameters.sheets.empty())
    sheets = read_directions(parameters, grid, parameters.sheets);
  if (!parameters.sheets.empty() && sheets.at != fibres.at)
    throw InputError(parameters.file,
                     "has fibres and sheets of which one stands at cells and one at points",
                     "Write both at cells or both at points");
  foreign.mesh.fibres.given = {fibres.at, std::move(fibres.vectors), std::move(sheets.vectors)};
}

}  // namespace lv::mesh_io
