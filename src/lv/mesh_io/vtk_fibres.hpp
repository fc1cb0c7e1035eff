#pragma once

#include "lv/mesh_io/foreign_mesh.hpp"

class vtkUnstructuredGrid;

namespace lv::mesh_io {

/// Reads the directions that the parameters name into `foreign.mesh.fibres.given`, as they are:
/// arrays of the grid at its cells or points, or files of the same cells as SimVascular writes
/// them. Notes arrays that look like fibres and are not named.
void read_vtk_fibres(const mesh::ImportParameters& parameters, vtkUnstructuredGrid& grid,
                     ForeignMesh& foreign);

}  // namespace lv::mesh_io
