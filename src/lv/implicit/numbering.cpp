#include "lv/implicit/numbering.hpp"

#include <algorithm>

namespace lv::implicit {
namespace {

/// The lowest rank whose elements have each of the unknowns first, first + stride, ...
std::vector<int> lowest_owners(const Pattern& pattern, int first, int stride, int count,
                               int ranks) {
  std::vector<int> result(count, ranks - 1);
  for (std::size_t g = 0; g < pattern.groups.size(); ++g) {
    for (const int unknown : pattern.groups[g]) {
      const int thing = (unknown - first) / stride;
      if (unknown >= first && thing < count)
        result[thing] = std::min(result[thing], pattern.owners[g]);
    }
  }
  return result;
}

}  // namespace

Runs::Runs(std::vector<int> owners, int ranks)
    : owners_(std::move(owners)), numbers_(owners_.size()), first_(ranks + 1, 0) {
  for (const int rank : owners_)
    ++first_[rank + 1];
  for (std::size_t r = 1; r < first_.size(); ++r)
    first_[r] += first_[r - 1];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t thing = 0; thing < owners_.size(); ++thing)
    numbers_[thing] = next[owners_[thing]]++;
}

int Runs::begin() const {
  return begin(parallel::rank());
}

int Runs::end() const {
  return end(parallel::rank());
}

Numbering::Numbering(const Pattern& pattern, int ranks)
    : nodes_(lowest_owners(pattern, 0, 3, pattern.nodes, ranks), ranks),
      pressures_(lowest_owners(pattern, pattern.displacements(), 1, pattern.pressures, ranks),
                 ranks),
      numbers_(pattern.size()) {
  for (int a = 0; a < pattern.nodes; ++a)
    for (int i = 0; i < 3; ++i)
      numbers_[3 * a + i] = 3 * nodes_[a] + i + pressures_.begin(nodes_.owner(a));
  for (int p = 0; p < pattern.pressures; ++p)
    numbers_[pattern.displacements() + p] = 3 * nodes_.end(pressures_.owner(p)) + pressures_[p];
}

}  // namespace lv::implicit
