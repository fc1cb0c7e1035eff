#include "lv/mesh_io/read_vtk.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh_io/stated_space.hpp"
#include "lv/mesh_io/vtk_fibres.hpp"
#include "lv/mesh_io/vtk_grid.hpp"
#include "lv/mesh_io/vtk_sides.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

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

/// The volume cells at which a cell array of zeros and ones is one.
std::vector<bool> read_infarcted(const mesh::ImportParameters& parameters,
                                 vtkUnstructuredGrid& grid) {
  const std::string& name = parameters.infarct_set;
  vtkDataArray& array = find_array(parameters.file, *grid.GetCellData(), grid.GetNumberOfCells(), 1,
                                   "cell array", name);
  std::vector<bool> infarcted;
  for (vtkIdType c = 0; c < array.GetNumberOfTuples(); ++c) {
    if (shape_of(grid.GetCellType(c)).dimension != 3)
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

ForeignMesh read_vtk(const mesh::ImportParameters& parameters) {
  const auto grid = read_grid(parameters.file);
  ForeignMesh foreign = to_mesh(parameters.file, *grid);
  if (parameters.sides == mesh::SideSource::tags)
    foreign.sides = read_vtk_sides(parameters, *grid);
  foreign.mesh.infarct = read_infarct(parameters, *grid);
  if (!parameters.infarct_set.empty())
    foreign.infarcted = read_infarcted(parameters, *grid);
  read_vtk_fibres(parameters, *grid, foreign);
  return foreign;
}

}  // namespace lv::mesh_io
