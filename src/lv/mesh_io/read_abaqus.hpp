#pragma once

#include "lv/mesh_io/foreign_mesh.hpp"

namespace lv::mesh_io {

/// Reads nodes, C3D8 and C3D4 elements (any suffix) and the tagged sides of an ABAQUS input file,
/// following *Include. Names are the same in upper and lower case. Face label Sk is face k of the
/// cell.
[[nodiscard]] ForeignMesh read_abaqus(const mesh::ImportParameters& parameters);

}  // namespace lv::mesh_io
