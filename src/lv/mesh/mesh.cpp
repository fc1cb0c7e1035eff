#include "lv/mesh/mesh.hpp"

#include <algorithm>
#include <map>

namespace lv::mesh {

std::vector<int> surface_nodes(const Surface& surface) {
  std::vector<int> nodes = surface.nodes;
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<std::array<int, 2>> boundary_edges(const Surface& surface) {
  std::map<std::array<int, 2>, std::pair<std::array<int, 2>, int>> sides;
  for (int f = 0; f < surface.size(); ++f) {
    const auto face = surface.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::array<int, 2> side{face[i], face[(i + 1) % face.size()]};
      std::array<int, 2> key = side;
      std::sort(key.begin(), key.end());
      auto& entry = sides[key];
      entry.first = side;
      ++entry.second;
    }
  }
  std::vector<std::array<int, 2>> edges;
  for (const auto& [key, entry] : sides)
    if (entry.second == 1)
      edges.push_back(entry.first);
  return edges;
}

}  // namespace lv::mesh
