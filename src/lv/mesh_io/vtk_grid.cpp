#include "lv/mesh_io/vtk_grid.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/mesh_io/foreign_mesh.hpp"
#include "lv/mesh_io/vtk_file.hpp"

#include <fmt/format.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace lv::mesh_io {
namespace {

bool is_legacy(const std::string& file) {
  return ending_of(file) == ".vtk";
}

vtkSmartPointer<vtkUnstructuredGrid> read_legacy_grid(const std::string& file) {
  check_legacy_cells(file);
  vtkNew<vtkUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllFieldsOn();
  if (reader->IsFileUnstructuredGrid() == 0)
    throw InputError(file, "is not a VTK file of an unstructured grid",
                     "Write the volume cells as DATASET UNSTRUCTURED_GRID");
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid> read_xml_grid(const std::string& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (reader->CanReadFile(file.c_str()) == 0)
    throw InputError(file, "is not a VTK file of type UnstructuredGrid",
                     "Write the volume cells as .vtu");
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string& file) {
  require_readable(file, "Check its name");
  auto grid = read_by_vtk(
      file, [&] { return is_legacy(file) ? read_legacy_grid(file) : read_xml_grid(file); });
  const vtkUnsignedCharArray* types = grid->GetCellTypesArray();
  if (types != nullptr && types->GetNumberOfTuples() != grid->GetNumberOfCells())
    throw InputError(file, "has cells without a type", "The file seems to be damaged");
  check_cells(file, grid->GetCells(), grid->GetNumberOfPoints());
  return grid;
}

VtkShape shape_of(int cell_type) {
  switch (cell_type) {
    case VTK_EMPTY_CELL:
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
      return {.dimension = 0};
    case VTK_LINE:
    case VTK_POLY_LINE:
    case VTK_QUADRATIC_EDGE:
    case VTK_CUBIC_LINE:
    case VTK_LAGRANGE_CURVE:
    case VTK_BEZIER_CURVE:
      return {.dimension = 1};
    case VTK_TRIANGLE:
      return {.dimension = 2, .corners = 3, .is_linear = true};
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_BIQUADRATIC_TRIANGLE:
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_BEZIER_TRIANGLE:
      return {.dimension = 2, .corners = 3};
    case VTK_QUAD:
    case VTK_PIXEL:
      return {.dimension = 2, .corners = 4, .is_linear = true};
    case VTK_QUADRATIC_QUAD:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_BEZIER_QUADRILATERAL:
      return {.dimension = 2, .corners = 4};
    case VTK_TRIANGLE_STRIP:
    case VTK_POLYGON:
    case VTK_QUADRATIC_LINEAR_QUAD:
    case VTK_QUADRATIC_POLYGON:
      return {.dimension = 2};
    case VTK_HEXAHEDRON:
      return {.corners = 8, .is_linear = true, .name = hexahedron_name};
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_HEXAHEDRON:
      return {.corners = 8, .name = hexahedron_name};
    case VTK_TETRA:
      return {.corners = 4, .is_linear = true, .name = tetrahedron_name};
    case VTK_QUADRATIC_TETRA:
    case VTK_LAGRANGE_TETRAHEDRON:
    case VTK_BEZIER_TETRAHEDRON:
      return {.corners = 4, .name = tetrahedron_name};
    default:
      return {.name = vtkCellTypes::GetClassNameFromTypeId(cell_type)};
  }
}

std::vector<int> corners_of(const std::string& file, vtkUnstructuredGrid& grid, std::int64_t cell) {
  const VtkShape shape = shape_of(grid.GetCellType(cell));
  vtkNew<vtkIdList> points;
  grid.GetCellPoints(cell, points);
  const vtkIdType count = points->GetNumberOfIds();
  if (shape.is_linear ? count != shape.corners : count < shape.corners)
    throw InputError(file, fmt::format("cell {} has {} points", cell, count),
                     fmt::format("Cells of its type have {}{}; the file seems to be damaged",
                                 shape.is_linear ? "" : "more than ", shape.corners));
  std::vector<int> corners;
  for (int i = 0; i < shape.corners; ++i)
    corners.push_back(static_cast<int>(points->GetId(i)));
  return corners;
}

std::vector<std::string> array_names(vtkFieldData& data) {
  std::vector<std::string> names;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
    if (data.GetArrayName(i) != nullptr)
      names.emplace_back(data.GetArrayName(i));
  return names;
}

vtkDataArray& find_array(const std::string& file, vtkFieldData& data, std::int64_t count,
                         int components, const std::string& what, const std::string& name) {
  vtkDataArray* array = data.GetArray(name.c_str());
  if (array == nullptr)
    fail_missing_tag(file, what, name, array_names(data));
  if (array->GetNumberOfComponents() != components)
    throw InputError(file,
                     fmt::format("{} \"{}\" has {} component{} instead of {}", what, name,
                                 array->GetNumberOfComponents(),
                                 array->GetNumberOfComponents() == 1 ? "" : "s", components),
                     components == 1 ? "It must have one number per point or cell"
                                     : "It must have one vector per point or cell");
  if (array->GetNumberOfTuples() != count)
    throw InputError(file,
                     fmt::format("{} \"{}\" has {} values for {} places", what, name,
                                 array->GetNumberOfTuples(), count),
                     "The file seems to be truncated or damaged");
  return *array;
}

}  // namespace lv::mesh_io
