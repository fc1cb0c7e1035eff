#pragma once

#include "lv/mesh/mesh.hpp"

#include <array>
#include <vector>

namespace lv::mesh {

/// A point of a cell: the values of the nodes' shape functions there, and the volume that it stands
/// for [mm^3].
struct CellPoint {
  std::array<double, 8> shape;
  double volume;
};

/// Points spread evenly over a cell: 4 x 4 x 4 in a hexahedron, 20 in a tetrahedron, each the
/// middle of its share. The part of a cell inside a region is that of the points inside it, however
/// few of its nodes or centres are.
[[nodiscard]] std::vector<CellPoint> spread_points(const Mesh& mesh, int cell);

}  // namespace lv::mesh
