#pragma once

#include "lv/mesh/mesh.hpp"

#include <span>
#include <vector>

/// The quadratic elements of a mesh of order 2.
namespace lv::mesh {

/// How many cells of a mesh of this order, its linear parts, make one finite element.
[[nodiscard]] constexpr int cells_per_element(int order) {
  return order == 2 ? 8 : 1;
}

/// Nodes of an element or a side of the given order, and how many there are of it.
struct ElementNodes {
  int nodes_per_element = 0;
  std::vector<int> nodes;  ///< element after element

  [[nodiscard]] int size() const { return static_cast<int>(nodes.size()) / nodes_per_element; }
  [[nodiscard]] std::span<const int> element(int e) const {
    return {nodes.data() + static_cast<std::ptrdiff_t>(e) * nodes_per_element,
            static_cast<std::size_t>(nodes_per_element)};
  }
};

/// The elements of a mesh as finite elements of its order.
///
///   hexahedra:  the (order + 1)^3 lattice, the first direction running fastest;
///   tetrahedra: the four corners, then the middles of the edges 01 12 20 03 13 23 (order 2).
[[nodiscard]] ElementNodes elements(const Mesh& mesh);

/// The sides of elements of a kind and order on a surface of their mesh, normals out of the wall.
///
///   quadrilaterals: the (order + 1)^2 lattice, the first direction running fastest;
///   triangles:      the three corners, then the middles of the edges 01 12 20 (order 2).
[[nodiscard]] ElementNodes sides(CellKind kind, int order, const Surface& surface);

/// Volume of every cell as the finite elements have it, int dX [mm^3]: of a part of a quadratic
/// element int det(dX/dxi) dxi over its share of the reference element, with the element's own
/// shape functions, so that the parts of a curved element add up to it. Exact.
[[nodiscard]] std::vector<double> cell_volumes(const Mesh& mesh);

}  // namespace lv::mesh
