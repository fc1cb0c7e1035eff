#include "lv/mesh/read_vtk.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/vtk_file.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <charconv>
#include <cmath>
#include <optional>

namespace lv::mesh {
namespace {

bool is_legacy(const std::string& file) {
  return !file.ends_with('u') && !file.ends_with('U');
}

vtkSmartPointer<vtkUnstructuredGrid> read_legacy(const std::string& file) {
  check_legacy_cells(file);
  vtkNew<vtkUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->ReadAllScalarsOn();
  reader->ReadAllFieldsOn();
  if (reader->IsFileUnstructuredGrid() == 0)
    throw InputError(file, "is not a VTK file of an unstructured grid",
                     "Write the volume cells as DATASET UNSTRUCTURED_GRID");
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid> read_xml(const std::string& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (reader->CanReadFile(file.c_str()) == 0)
    throw InputError(file, "is not a VTK file of type UnstructuredGrid",
                     "Write the volume cells as .vtu");
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string& file) {
  const auto grid =
      read_by_vtk(file, [&] { return is_legacy(file) ? read_legacy(file) : read_xml(file); });
  const vtkUnsignedCharArray* types = grid->GetCellTypesArray();
  if (types != nullptr && types->GetNumberOfTuples() != grid->GetNumberOfCells())
    throw InputError(file, "has cells without a type", "The file seems to be damaged");
  check_cells(file, grid->GetCells(), grid->GetNumberOfPoints());
  return grid;
}

int dimension(int cell_type) {
  switch (cell_type) {
    case VTK_EMPTY_CELL:
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
      return 0;
    case VTK_LINE:
    case VTK_POLY_LINE:
    case VTK_QUADRATIC_EDGE:
      return 1;
    case VTK_TRIANGLE:
    case VTK_TRIANGLE_STRIP:
    case VTK_POLYGON:
    case VTK_PIXEL:
    case VTK_QUAD:
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_QUADRATIC_QUAD:
    case VTK_BIQUADRATIC_QUAD:
      return 2;
    default:
      return 3;
  }
}

std::string shape(int cell_type) {
  switch (cell_type) {
    case VTK_HEXAHEDRON:
      return hexahedron_name;
    case VTK_TETRA:
      return tetrahedron_name;
    default:
      return vtkCellTypes::GetClassNameFromTypeId(cell_type);
  }
}

ForeignMesh to_mesh(const std::string& file, vtkUnstructuredGrid& grid) {
  ForeignMesh foreign;
  foreign.files = {file};
  std::map<std::string, int> shapes;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c)
    if (dimension(grid.GetCellType(c)) == 3)
      ++shapes[shape(grid.GetCellType(c))];
  foreign.mesh.kind = only_kind(file, shapes);
  for (vtkIdType p = 0; p < grid.GetNumberOfPoints(); ++p) {
    foreign.mesh.nodes.emplace_back(grid.GetPoint(p));
    foreign.node_numbers.push_back(p);
  }
  vtkNew<vtkIdList> points;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    if (dimension(grid.GetCellType(c)) != 3)
      continue;
    grid.GetCellPoints(c, points);
    if (points->GetNumberOfIds() != nodes_per_cell(foreign.mesh.kind))
      throw InputError(file, fmt::format("cell {} has {} points", c, points->GetNumberOfIds()),
                       "A hexahedron has 8, a tetrahedron 4; the file seems to be damaged");
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
      foreign.mesh.cells.push_back(static_cast<int>(points->GetId(i)));
    foreign.cell_numbers.push_back(c);
  }
  return foreign;
}

std::vector<std::string> array_names(vtkFieldData& data) {
  std::vector<std::string> names;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
    if (data.GetArrayName(i) != nullptr)
      names.emplace_back(data.GetArrayName(i));
  return names;
}

/// The array of that name with one number for each of `count` points or cells.
vtkDataArray& find_array(const std::string& file, vtkFieldData& data, vtkIdType count,
                         const std::string& what, const std::string& name) {
  vtkDataArray* array = data.GetArray(name.c_str());
  if (array == nullptr)
    fail_missing_tag(file, what, name, array_names(data));
  if (array->GetNumberOfComponents() != 1)
    throw InputError(
        file,
        fmt::format("{} \"{}\" has {} components", what, name, array->GetNumberOfComponents()),
        "It must have one number per point or cell");
  if (array->GetNumberOfTuples() != count)
    throw InputError(file,
                     fmt::format("{} \"{}\" has {} numbers for {} places", what, name,
                                 array->GetNumberOfTuples(), count),
                     "The file seems to be truncated or damaged");
  return *array;
}

/// The nodes at which a point array of zeros and ones is one.
ForeignSide side_of_points(const std::string& file, vtkUnstructuredGrid& grid,
                           const std::string& tag) {
  vtkDataArray& array =
      find_array(file, *grid.GetPointData(), grid.GetNumberOfPoints(), "point array", tag);
  ForeignSide side;
  for (vtkIdType p = 0; p < array.GetNumberOfTuples(); ++p) {
    const double value = array.GetTuple1(p);
    if (value != 0.0 && value != 1.0)
      throw InputError(file, fmt::format("point array \"{}\" is {} at point {}", tag, value, p),
                       "It must be 1 on the side and 0 elsewhere");
    if (value == 1.0)
      side.nodes.push_back(static_cast<int>(p));
  }
  return side;
}

FaceKey key_of_cell(const std::string& file, vtkUnstructuredGrid& grid, vtkIdType cell) {
  vtkNew<vtkIdList> points;
  grid.GetCellPoints(cell, points);
  if (points->GetNumberOfIds() != 3 && points->GetNumberOfIds() != 4)
    throw InputError(file, fmt::format("face {} has {} points", cell, points->GetNumberOfIds()),
                     "It must have 3 or 4; the file seems to be damaged");
  std::vector<int> nodes;
  for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    nodes.push_back(static_cast<int>(points->GetId(i)));
  return face_key(nodes);
}

bool is_face(int cell_type) {
  return cell_type == VTK_TRIANGLE || cell_type == VTK_QUAD || cell_type == VTK_PIXEL;
}

/// The surface cells by their value in a cell array.
std::map<double, ForeignSide> sides_by_value(const std::string& file, vtkUnstructuredGrid& grid,
                                             vtkDataArray& array) {
  std::map<double, ForeignSide> sides;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c)
    if (is_face(grid.GetCellType(c)))
      sides[array.GetTuple1(c)].faces.push_back(key_of_cell(file, grid, c));
  return sides;
}

ForeignSide side_of_value(const ImportParameters& parameters, const std::string& tag,
                          const std::map<double, ForeignSide>& sides) {
  double wanted = 0.0;
  const auto [end, error] = std::from_chars(tag.data(), tag.data() + tag.size(), wanted);
  if (error != std::errc() || end != tag.data() + tag.size())
    throw InputError(
        parameters.file,
        fmt::format("\"{}\" is not a number of the cell array \"{}\"", tag, parameters.side_array),
        "Give the side's number, or name no cell array to use point arrays");
  if (const auto found = sides.find(wanted); found != sides.end())
    return found->second;
  std::vector<std::string> tags;
  for (const auto& [value, side] : sides)
    tags.push_back(fmt::format("{}", value));
  fail_missing_tag(parameters.file,
                   fmt::format("surface cell whose \"{}\" is", parameters.side_array), tag, tags);
}

std::vector<ForeignSide> read_sides(const ImportParameters& parameters, vtkUnstructuredGrid& grid) {
  if (parameters.side_array.empty())
    return find_sides(parameters, [&](const std::string& tag) {
      return side_of_points(parameters.file, grid, tag);
    });
  const auto by_value =
      sides_by_value(parameters.file, grid,
                     find_array(parameters.file, *grid.GetCellData(), grid.GetNumberOfCells(),
                                "cell array", parameters.side_array));
  return find_sides(
      parameters, [&](const std::string& tag) { return side_of_value(parameters, tag, by_value); });
}

std::vector<double> read_infarct(const ImportParameters& parameters, vtkUnstructuredGrid& grid) {
  const bool named = !parameters.infarct_array.empty();
  const std::string name = named ? parameters.infarct_array : "infarct";
  if (!named && grid.GetPointData()->GetArray(name.c_str()) == nullptr)
    return {};
  vtkDataArray& array = find_array(parameters.file, *grid.GetPointData(), grid.GetNumberOfPoints(),
                                   "point array", name);
  std::vector<double> M;
  for (vtkIdType p = 0; p < array.GetNumberOfTuples(); ++p)
    M.push_back(array.GetTuple1(p));
  return M;
}

/// The volume cells at which a cell array of zeros and ones is one.
std::vector<bool> read_infarcted(const ImportParameters& parameters, vtkUnstructuredGrid& grid) {
  const std::string& name = parameters.infarct_set;
  vtkDataArray& array =
      find_array(parameters.file, *grid.GetCellData(), grid.GetNumberOfCells(), "cell array", name);
  std::vector<bool> infarcted;
  for (vtkIdType c = 0; c < array.GetNumberOfTuples(); ++c) {
    if (dimension(grid.GetCellType(c)) != 3)
      continue;
    const double value = array.GetTuple1(c);
    if (value != 0.0 && value != 1.0)
      throw InputError(parameters.file,
                       fmt::format("cell array \"{}\" is {} at cell {}", name, value, c),
                       "It must be 1 in the infarct and 0 elsewhere");
    infarcted.push_back(value == 1.0);
  }
  return infarcted;
}

}  // namespace

ForeignMesh read_vtk(const ImportParameters& parameters) {
  const auto grid = read_grid(parameters.file);
  ForeignMesh foreign = to_mesh(parameters.file, *grid);
  if (parameters.sides == SideSource::tags)
    foreign.sides = read_sides(parameters, *grid);
  foreign.mesh.infarct = read_infarct(parameters, *grid);
  if (!parameters.infarct_set.empty())
    foreign.infarcted = read_infarcted(parameters, *grid);
  return foreign;
}

}  // namespace lv::mesh
