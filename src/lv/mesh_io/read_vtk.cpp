#include "lv/mesh_io/read_vtk.hpp"

#include "lv/base/check.hpp"
#include "lv/base/printable.hpp"
#include "lv/mesh_io/stated_space.hpp"
#include "lv/mesh_io/vtk_fibres.hpp"
#include "lv/mesh_io/vtk_grid.hpp"
#include "lv/mesh_io/vtk_sides.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <optional>

namespace lv::mesh_io {
namespace {

ForeignMesh to_mesh(const std::string& file, vtkUnstructuredGrid& grid) {
  ForeignMesh foreign;
  foreign.files = {file};
  foreign.in_ras = says_ras(file, grid);
  std::map<std::string, int> shapes;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c)
    if (const VtkShape shape = shape_of(grid.GetCellType(c)); shape.dimension == 3)
      ++shapes[shape.name];
  foreign.mesh.kind = only_kind(file, shapes);
  for (vtkIdType p = 0; p < grid.GetNumberOfPoints(); ++p) {
    foreign.mesh.nodes.emplace_back(grid.GetPoint(p));
    foreign.node_numbers.push_back(p);
  }
  int quadratic = 0;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    const VtkShape shape = shape_of(grid.GetCellType(c));
    if (shape.dimension != 3)
      continue;
    const std::vector<int> corners = corners_of(file, grid, c);
    foreign.mesh.cells.insert(foreign.mesh.cells.end(), corners.begin(), corners.end());
    foreign.cell_numbers.push_back(c);
    quadratic += shape.is_linear ? 0 : 1;
  }
  foreign.note_quadratic(quadratic);
  return foreign;
}

std::vector<double> read_infarct(const mesh::ImportParameters& parameters,
                                 vtkUnstructuredGrid& grid) {
  const bool named = !parameters.infarct_array.empty();
  const std::string name = named ? parameters.infarct_array : "infarct";
  if (!named && grid.GetPointData()->GetArray(name.c_str()) == nullptr)
    return {};
  vtkDataArray& array = find_array(parameters.file, *grid.GetPointData(), grid.GetNumberOfPoints(),
                                   1, "point array", name);
  std::vector<double> M;
  for (vtkIdType p = 0; p < array.GetNumberOfTuples(); ++p)
    M.push_back(array.GetTuple1(p));
  return M;
}

/// The volume cells at which a cell array is one; what lies between zero and one is border zone,
/// which is made anew.
void read_infarcted(const mesh::ImportParameters& parameters, vtkUnstructuredGrid& grid,
                    ForeignMesh& foreign) {
  const std::string& name = parameters.infarct_set;
  vtkDataArray& array = find_array(parameters.file, *grid.GetCellData(), grid.GetNumberOfCells(), 1,
                                   "cell array", name);
  int between = 0;
  for (vtkIdType c = 0; c < array.GetNumberOfTuples(); ++c) {
    if (shape_of(grid.GetCellType(c)).dimension != 3)
      continue;
    const double value = array.GetTuple1(c);
    if (!(value >= 0.0 && value <= 1.0))
      throw InputError(
          parameters.file, fmt::format("cell array \"{}\" is {} at cell {}", name, value, c),
          "It must be 1 in the infarct, 0 in healthy muscle, and between them in the border zone");
    between += value > 0.0 && value < 1.0 ? 1 : 0;
    foreign.infarcted.push_back(value == 1.0);
  }
  if (between > 0)
    foreign.notes.push_back(
        fmt::format("cell array \"{}\" lies between 0 and 1 in {} cells: they are no infarct but "
                    "border zone, which infarct.border makes anew round the cells with 1",
                    printable(name), between));
}

/// Whether an array has one number each and one of the first `count` is not zero.
bool shows_something(vtkDataArray* array, vtkIdType count) {
  if (array == nullptr || array->GetNumberOfComponents() != 1 ||
      array->GetNumberOfTuples() != count)
    return false;
  for (vtkIdType i = 0; i < count; ++i)
    if (array->GetTuple1(i) != 0.0)
      return true;
  return false;
}

/// The first array that is called as an infarct is: at points, where it can be read as it is, else
/// in cells.
std::optional<UnreadInfarct> unread_infarct(vtkUnstructuredGrid& grid) {
  const auto find = [](vtkDataSetAttributes& data, vtkIdType count,
                       bool at_points) -> std::optional<UnreadInfarct> {
    for (const std::string& name : array_names(data))
      if (is_infarct_name(name) && shows_something(data.GetArray(name.c_str()), count))
        return UnreadInfarct{name, at_points};
    return {};
  };
  const auto at_points = find(*grid.GetPointData(), grid.GetNumberOfPoints(), true);
  return at_points ? at_points : find(*grid.GetCellData(), grid.GetNumberOfCells(), false);
}

}  // namespace

ForeignMesh read_vtk(const mesh::ImportParameters& parameters) {
  const auto grid = read_grid(parameters.file);
  ForeignMesh foreign = to_mesh(parameters.file, *grid);
  if (parameters.sides == mesh::SideSource::tags)
    foreign.sides = read_vtk_sides(parameters, *grid);
  foreign.mesh.infarct = read_infarct(parameters, *grid);
  if (!parameters.infarct_set.empty())
    read_infarcted(parameters, *grid, foreign);
  else if (std::all_of(foreign.mesh.infarct.begin(), foreign.mesh.infarct.end(),
                       [](double M) { return M == 0.0; }))
    foreign.unread = unread_infarct(*grid);
  read_vtk_fibres(parameters, *grid, foreign);
  return foreign;
}

}  // namespace lv::mesh_io
