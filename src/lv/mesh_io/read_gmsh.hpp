#pragma once

#include "lv/mesh_io/foreign_mesh.hpp"

namespace lv::mesh_io {

/// Reads a Gmsh .msh file of format 2.2 or 4.1, text or binary, with Gmsh's own reader.
[[nodiscard]] ForeignMesh read_gmsh(const mesh::ImportParameters& parameters);

}  // namespace lv::mesh_io
