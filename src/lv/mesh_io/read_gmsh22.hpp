#pragma once

#include "lv/mesh_io/foreign_mesh.hpp"

namespace lv::mesh_io {

/// Reads a Gmsh file of format 2.2 (gmsh22_file.hpp). Elements that stand there once for each of
/// their physical groups, as Gmsh writes those of several, are taken once.
[[nodiscard]] ForeignMesh read_gmsh22(const mesh::ImportParameters& parameters);

}  // namespace lv::mesh_io
