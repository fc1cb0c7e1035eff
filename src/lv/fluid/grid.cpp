#include "lv/fluid/grid.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::fluid {

Vec3 Grid::upper() const {
  return lower + Vec3(cells[0] * spacing[0], cells[1] * spacing[1], cells[2] * spacing[2]);
}

Vec3 Grid::face(int c, int i, int j, int k) const {
  Vec3 index(i + 0.5, j + 0.5, k + 0.5);
  index[c] -= 0.5;
  return lower + index.cwiseProduct(spacing);
}

int most_ranks(const std::array<int, 3>& cells) {
  return std::max(1, std::min(cells[0], cells[2] / 2));
}

Slab slab_of(const Grid& grid, int rank, int ranks) {
  const int most = most_ranks(grid.cells);
  if (ranks > most)
    throw InputError(
        "--ranks " + std::to_string(ranks),
        fmt::format("the box has {} cells along x and {} along z; a rank needs 1 and 2",
                    grid.cells[0], grid.cells[2]),
        fmt::format("Use at most {} ranks, or a finer grid", most));
  return {parallel::share(grid.cells[2], rank, ranks), rank == 0, rank == ranks - 1};
}

Grid centred_grid(const Vec3& centre, const Vec3& size, const std::array<int, 3>& cells) {
  return {cells, centre - 0.5 * size, size.cwiseQuotient(Vec3(cells[0], cells[1], cells[2]))};
}

}  // namespace lv::fluid
