#include "lv/fluid/grid.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

namespace lv::fluid {

Vec3 Grid::upper() const {
  return lower + Vec3(cells[0] * spacing[0], cells[1] * spacing[1], cells[2] * spacing[2]);
}

Vec3 Grid::face(int c, int i, int j, int k) const {
  Vec3 index(i + 0.5, j + 0.5, k + 0.5);
  index[c] -= 0.5;
  return lower + index.cwiseProduct(spacing);
}

Slab slab_of(const Grid& grid, int rank, int ranks) {
  const int thinnest = grid.cells[2] / ranks;
  if (thinnest < 2)
    throw InputError(
        "--ranks " + std::to_string(ranks),
        fmt::format("the box has {} cells along z, fewer than 2 per rank", grid.cells[2]),
        fmt::format("Use at most {} ranks, or a finer grid", grid.cells[2] / 2));
  return {parallel::share(grid.cells[2], rank, ranks), rank == 0, rank == ranks - 1};
}

}  // namespace lv::fluid
