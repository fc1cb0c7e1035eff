#pragma once

#include "lv/base/parallel.hpp"

#include <vector>

namespace lv::implicit {

/// Which unknowns there are and which meet in an element: the displacement of node a along i is
/// 3 a + i, pressures follow.
struct Pattern {
  /// A node's place among the corners of its element: x = sum_c weight_c x_c.
  struct Share {
    int corner = 0;  ///< a node
    double weight = 0.0;
  };

  int nodes = 0;
  int pressures = 0;
  std::vector<std::vector<int>> groups;     ///< the unknowns of each element; of all ranks
  std::vector<int> owners;                  ///< the rank of each element
  std::vector<std::vector<Share>> corners;  ///< per node; empty where elements are linear

  [[nodiscard]] int displacements() const { return 3 * nodes; }
  [[nodiscard]] int size() const { return displacements() + pressures; }
};

/// Things numbered anew so that those of each rank are in one run.
class Runs {
 public:
  Runs(std::vector<int> owners, int ranks);

  [[nodiscard]] int owner(int thing) const { return owners_[thing]; }
  [[nodiscard]] int operator[](int thing) const { return numbers_[thing]; }
  [[nodiscard]] int begin(int rank) const { return first_[rank]; }
  [[nodiscard]] int end(int rank) const { return first_[rank + 1]; }
  [[nodiscard]] int size() const { return first_.back(); }

  [[nodiscard]] int begin() const;  ///< of this rank
  [[nodiscard]] int end() const;
  [[nodiscard]] int own() const { return end() - begin(); }
  [[nodiscard]] bool is_own(int thing) const {
    return numbers_[thing] >= begin() && numbers_[thing] < end();
  }

 private:
  std::vector<int> owners_, numbers_, first_;
};

/// The order of the unknowns in matrices: for each rank the displacements of its nodes, then its
/// pressures. What several elements share belongs to the lowest of their ranks.
class Numbering {
 public:
  explicit Numbering(const Pattern& pattern, int ranks = parallel::size());

  [[nodiscard]] int operator[](int unknown) const { return numbers_[unknown]; }
  [[nodiscard]] int begin() const { return 3 * nodes_.begin() + pressures_.begin(); }
  [[nodiscard]] int end() const { return 3 * nodes_.end() + pressures_.end(); }
  [[nodiscard]] const Runs& nodes() const { return nodes_; }
  [[nodiscard]] const Runs& pressures() const { return pressures_; }

 private:
  Runs nodes_, pressures_;
  std::vector<int> numbers_;
};

}  // namespace lv::implicit
