#pragma once

#include "lv/mesh/mesh.hpp"

#include <array>

namespace lv::test {

/// The kinds of cells that a mesh can have.
inline constexpr std::array kinds{mesh::CellKind::hexahedron, mesh::CellKind::tetrahedron};

}  // namespace lv::test
