#include "lv/implicit/partition.hpp"

#include "lv/mesh/quadratic.hpp"

#include "support/block_mesh.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

namespace {

using namespace lv;

/// Nodes that elements of several ranks have.
int shared_nodes(const mesh::ElementNodes& elements, const std::vector<int>& owners) {
  std::vector<std::set<int>> ranks(*std::max_element(elements.nodes.begin(), elements.nodes.end()) +
                                   1);
  for (int e = 0; e < elements.size(); ++e)
    for (const int node : elements.element(e))
      ranks[node].insert(owners[e]);
  return static_cast<int>(
      std::count_if(ranks.begin(), ranks.end(), [](const auto& r) { return r.size() > 1; }));
}

}  // namespace

TEST_CASE("ranks share elements evenly, with few nodes between them", "[unit][implicit]") {
  const mesh::ElementNodes elements = mesh::elements(test::cubes(mesh::CellKind::hexahedron, 8));
  for (const int ranks : {2, 3, 4}) {
    const std::vector<int> owners = implicit::partition(elements, ranks);
    REQUIRE(owners.size() == 512);
    std::vector<int> dealt_out(owners.size());
    for (std::size_t e = 0; e < dealt_out.size(); ++e)
      dealt_out[e] = static_cast<int>(e) % ranks;
    for (int rank = 0; rank < ranks; ++rank)
      CHECK(std::count(owners.begin(), owners.end(), rank) == Approx(512.0 / ranks).epsilon(0.1));
    CHECK(3 * shared_nodes(elements, owners) < shared_nodes(elements, dealt_out));
    CHECK(implicit::partition(elements, ranks) == owners);
  }
}

TEST_CASE("one rank has all elements", "[unit][implicit]") {
  const mesh::ElementNodes elements = mesh::elements(test::cubes(mesh::CellKind::tetrahedron, 2));
  CHECK(implicit::partition(elements, 1) ==
        std::vector<int>(static_cast<std::size_t>(elements.size()), 0));
}
