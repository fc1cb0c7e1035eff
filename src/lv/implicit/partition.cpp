#include "lv/implicit/partition.hpp"

#include "lv/base/check.hpp"

#include <metis.h>

#include <algorithm>
#include <set>

namespace lv::implicit {
namespace {

// ranks; METIS divides among few better by halves, again and again
constexpr int most_by_halves = 8;

/// The elements at each node.
std::vector<std::vector<int>> elements_of_nodes(const mesh::ElementNodes& elements) {
  std::vector<std::vector<int>> result(
      *std::max_element(elements.nodes.begin(), elements.nodes.end()) + 1);
  for (int e = 0; e < elements.size(); ++e)
    for (const int node : elements.element(e))
      result[node].push_back(e);
  return result;
}

/// Elements that share a node are neighbours: of element e those from first[e] to first[e + 1].
struct Neighbours {
  std::vector<idx_t> first{0};
  std::vector<idx_t> other;
};

Neighbours neighbours(const mesh::ElementNodes& elements) {
  const auto meeting = elements_of_nodes(elements);
  Neighbours result;
  for (int e = 0; e < elements.size(); ++e) {
    std::set<int> others;
    for (const int node : elements.element(e))
      others.insert(meeting[node].begin(), meeting[node].end());
    others.erase(e);
    result.other.insert(result.other.end(), others.begin(), others.end());
    result.first.push_back(static_cast<idx_t>(result.other.size()));
  }
  return result;
}

}  // namespace

std::vector<int> partition(const mesh::ElementNodes& elements, int ranks) {
  std::vector<idx_t> part(elements.size(), 0);
  if (ranks > 1) {
    Neighbours graph = neighbours(elements);
    idx_t count = elements.size();
    idx_t constraints = 1;
    idx_t parts = ranks;
    idx_t cut = 0;
    const auto divide = ranks <= most_by_halves ? METIS_PartGraphRecursive : METIS_PartGraphKway;
    const int answer =
        divide(&count, &constraints, graph.first.data(), graph.other.data(), nullptr, nullptr,
               nullptr, &parts, nullptr, nullptr, nullptr, &cut, part.data());
    LV_CHECK(answer == METIS_OK);
  }
  return {part.begin(), part.end()};
}

}  // namespace lv::implicit
