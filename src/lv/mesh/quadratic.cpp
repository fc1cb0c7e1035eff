#include "lv/mesh/quadratic.hpp"

#include "lv/mesh/shapes.hpp"

#include <array>

namespace lv::mesh {
namespace {

/// Where a node of an element is found: in a part of it, at a place of that part.
struct Place {
  int part, node;
};

std::vector<Place> hexahedron_places(int order) {
  std::vector<Place> places;
  for (int k = 0; k <= order; ++k) {
    for (int j = 0; j <= order; ++j) {
      for (int i = 0; i <= order; ++i) {
        // the part whose near corner (or, at the far end, far corner) lies at (i, j, k)
        const auto part = [&](int at) { return order == 2 && at == 2 ? 1 : order == 2 ? at : 0; };
        const auto corner = [&](int at) { return at == order ? 1 : 0; };
        places.push_back({part(k) * 4 + part(j) * 2 + part(i),
                          hexahedron_corner[corner(k) * 4 + corner(j) * 2 + corner(i)]});
      }
    }
  }
  return places;
}

/// As refine() cuts them.
std::vector<Place> places(CellKind kind, int order) {
  if (kind == CellKind::hexahedron)
    return hexahedron_places(order);
  if (order == 1)
    return {{0, 0}, {0, 1}, {0, 2}, {0, 3}};
  return {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
}

std::vector<Place> side_places(CellKind kind, int order) {
  if (kind == CellKind::hexahedron && order == 1)
    return {{0, 0}, {0, 1}, {0, 3}, {0, 2}};
  if (kind == CellKind::hexahedron)
    return {{0, 0}, {0, 1}, {1, 0}, {0, 3}, {0, 2}, {1, 1}, {3, 0}, {2, 1}, {2, 0}};
  if (order == 1)
    return {{0, 0}, {0, 1}, {0, 2}};
  return {{1, 0}, {2, 0}, {3, 0}, {0, 0}, {0, 1}, {0, 2}};
}

ElementNodes gather(std::span<const int> nodes, int nodes_per_part, int parts,
                    const std::vector<Place>& at) {
  ElementNodes result;
  result.nodes_per_element = static_cast<int>(at.size());
  const std::size_t stride = static_cast<std::size_t>(nodes_per_part) * parts;
  for (std::size_t first = 0; first < nodes.size(); first += stride)
    for (const Place& p : at)
      result.nodes.push_back(
          nodes[first + static_cast<std::size_t>(p.part) * nodes_per_part + p.node]);
  return result;
}

}  // namespace

ElementNodes elements(const Mesh& mesh) {
  return gather(mesh.cells, nodes_per_cell(mesh.kind), cells_per_element(mesh.order),
                places(mesh.kind, mesh.order));
}

ElementNodes sides(CellKind kind, int order, const Surface& surface) {
  return gather(surface.nodes, surface.nodes_per_face, order == 2 ? 4 : 1,
                side_places(kind, order));
}

}  // namespace lv::mesh
