#pragma once

#include "lv/mesh_io/foreign_mesh.hpp"

namespace lv::mesh_io {

/// Reads a Gmsh .msh file (gmsh_file.hpp). Elements that stand there once for each of their
/// physical groups, as Gmsh writes those of several in format 2.2, are taken once.
[[nodiscard]] ForeignMesh read_gmsh(const mesh::ImportParameters& parameters);

}  // namespace lv::mesh_io
