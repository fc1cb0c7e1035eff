#pragma once

#include "lv/mesh_io/foreign_mesh.hpp"

#include <vector>

class vtkUnstructuredGrid;

namespace lv::mesh_io {

/// Endocardium, epicardium and base of a grid, as the parameters name them: numbers in a cell array
/// of surface cells, point arrays that are 1 on a side, or files of the sides' surfaces (.vtp).
[[nodiscard]] std::vector<ForeignSide> read_vtk_sides(const mesh::ImportParameters& parameters,
                                                      vtkUnstructuredGrid& grid);

}  // namespace lv::mesh_io
