#include "lv/implicit/partition.hpp"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace lv::implicit {
namespace {

/// The elements at each node.
std::vector<std::vector<int>> elements_of_nodes(const mesh::ElementNodes& elements) {
  std::vector<std::vector<int>> result(
      *std::max_element(elements.nodes.begin(), elements.nodes.end()) + 1);
  for (int e = 0; e < elements.size(); ++e)
    for (const int node : elements.element(e))
      result[node].push_back(e);
  return result;
}

/// Elements that share a node are neighbours.
dealii::SparsityPattern neighbours(const mesh::ElementNodes& elements) {
  dealii::DynamicSparsityPattern pairs(elements.size());
  for (const auto& meeting : elements_of_nodes(elements))
    for (const int e : meeting)
      for (const int other : meeting)
        pairs.add(e, other);
  dealii::SparsityPattern result;
  result.copy_from(pairs);
  return result;
}

}  // namespace

std::vector<int> partition(const mesh::ElementNodes& elements, int ranks) {
  std::vector<unsigned> part(elements.size(), 0U);
  if (ranks > 1)
    dealii::SparsityTools::partition(neighbours(elements), ranks, part);
  return {part.begin(), part.end()};
}

}  // namespace lv::implicit
