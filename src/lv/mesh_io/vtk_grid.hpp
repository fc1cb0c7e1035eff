#pragma once

#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>
#include <vector>

class vtkDataArray;
class vtkFieldData;
class vtkUnstructuredGrid;

/// Unstructured grids as VTK reads them.
namespace lv::mesh_io {

/// Reads a legacy .vtk or an XML .vtu file with all its arrays. Throws InputError unless all cells
/// have a type and stand on points that there are.
[[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string& file);

/// What a type of VTK's cells is to a wall. VTK lists the corners of a cell first, then the nodes
/// between them.
struct VtkShape {
  int dimension = 3;
  int corners = 0;         ///< of tetrahedra, hexahedra, triangles and quadrilaterals
  bool is_linear = false;  ///< no nodes but the corners
  std::string name = {};   ///< of volume cells
};
[[nodiscard]] VtkShape shape_of(int cell_type);

/// The corners of a cell. Throws InputError when it has too few points, or too many.
[[nodiscard]] std::vector<int> corners_of(const std::string& file, vtkUnstructuredGrid& grid,
                                          std::int64_t cell);

[[nodiscard]] std::vector<std::string> array_names(vtkFieldData& data);

/// The array of that name with so many components for each of `count` points or cells; `what` says
/// what it is ("point array"). Throws InputError when there is none.
[[nodiscard]] vtkDataArray& find_array(const std::string& file, vtkFieldData& data,
                                       std::int64_t count, int components, const std::string& what,
                                       const std::string& name);

}  // namespace lv::mesh_io
