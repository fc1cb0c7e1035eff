#pragma once

#include "lv/mesh_io/foreign_mesh.hpp"

namespace lv::mesh_io {

/// Reads an unstructured grid from a legacy .vtk or an XML .vtu file with VTK's own readers. Cells
/// and points are numbered from 0, as ParaView shows them.
[[nodiscard]] ForeignMesh read_vtk(const mesh::ImportParameters& parameters);

}  // namespace lv::mesh_io
