#include "lv/fluid/box_transform.hpp"

#include <mpi.h>

#include <algorithm>

namespace lv::fluid {
namespace {

constexpr int widest_tile = 48;  // keeps a tile in the first cache levels

/// Tile width that covers n columns with little waste: a multiple of 4, not of 32 (rows would
/// collide in the cache).
int tile_width(int n) {
  const int tiles = (n + widest_tile - 1) / widest_tile;
  const int width = ((n + tiles - 1) / tiles + 3) / 4 * 4;
  return width % 32 == 0 ? width + 4 : width;
}

LineTransform::Kind kind_of(int component, int axis) {
  return component == axis ? LineTransform::Kind::cosine : LineTransform::Kind::sine;
}

LineTransform line_transform(const Grid& grid, int component, int axis, int lines) {
  return {kind_of(component, axis), grid.cells[axis], tile_width(lines)};
}

/// Calls tile(first, count) for runs of at most `width` that cover 0..n.
template <class Tile>
void for_tiles(int n, int width, const Tile& tile) {
  for (int first = 0; first < n; first += width)
    tile(first, std::min(width, n - first));
}

}  // namespace

ModeLayout::ModeLayout(const Grid& grid, int component, int rank, int ranks)
    : first_y(component == 1 ? 0 : 1),
      first_z(component == 2 ? 0 : 1),
      count_y(grid.points(component, 1)),
      count_z(grid.points(component, 2)) {
  const parallel::Range run = parallel::share(grid.cells[0], rank, ranks);
  const bool has_zero = component == 0 && rank == 0;
  first_x = has_zero ? 0 : run.begin + 1;
  count_x = run.size() + (has_zero ? 1 : 0);
}

ComponentTransform::ComponentTransform(const Grid& grid, const Slab& slab, int component)
    : points_{grid.points(component, 0), grid.points(component, 1), slab.points(component)},
      layout_(grid, component, parallel::rank(), parallel::size()),
      x_(line_transform(grid, component, 0, points_[1])),
      y_(line_transform(grid, component, 1, points_[0])),
      z_(line_transform(grid, component, 2, layout_.count_x * layout_.count_y)),
      plane_(static_cast<std::size_t>(points_[0]) * points_[1]),
      work_(layout_.size()) {
  const int ranks = parallel::size();
  for (int r = 0; r < ranks; ++r) {
    layouts_.emplace_back(grid, component, r, ranks);
    rank_of_x_.insert(rank_of_x_.end(), layouts_.back().count_x, r);
    planes_of_rank_.push_back(slab_of(grid, r, ranks).points(component));
  }
  if (ranks > 1)
    buffer_.resize(static_cast<std::size_t>(points_[0]) * points_[1] * points_[2]);
}

/// Row (plane k of this slab, mode index i along x) in the exchange buffer: one block per rank, in
/// it the planes, in them the rows of y modes.
double* ComponentTransform::exchange_row(AlignedValues& buffer, int k, int i) const {
  const int owner = rank_of_x_[i];
  std::size_t rows_before = 0;
  for (int r = 0; r < owner; ++r)
    rows_before += layouts_[r].count_x;
  const std::size_t row_in_block =
      static_cast<std::size_t>(k) * layouts_[owner].count_x + (i - rows_before);
  return buffer.data() + (rows_before * points_[2] + row_in_block) * points_[1];
}

void ComponentTransform::planes_to_modes(const Component& points, AlignedValues& buffer) {
  const auto [nx, ny, nz] = points_;
  for (int k = 0; k < nz; ++k) {
    for_tiles(nx, y_.columns(), [&, ny = ny](int first, int count) {
      for (int j = 0; j < ny; ++j)
        y_.load_point(j, points.row(j, k) + first, count);
      y_.to_modes();
      for (int j = 0; j < ny; ++j)
        y_.store_mode(j, &plane_[static_cast<std::size_t>(first) * ny + j], count, ny);
    });
    for_tiles(ny, x_.columns(), [&, nx = nx, ny = ny](int first, int count) {
      for (int i = 0; i < nx; ++i)
        x_.load_point(i, &plane_[static_cast<std::size_t>(i) * ny + first], count);
      x_.to_modes();
      for (int i = 0; i < nx; ++i)
        x_.store_mode(i, exchange_row(buffer, k, i) + first, count);
    });
  }
}

void ComponentTransform::planes_to_points(AlignedValues& buffer, Component& points) {
  const auto [nx, ny, nz] = points_;
  for (int k = 0; k < nz; ++k) {
    for_tiles(ny, x_.columns(), [&, nx = nx](int first, int count) {
      for (int i = 0; i < nx; ++i)
        x_.load_mode(i, exchange_row(buffer, k, i) + first, count);
      x_.to_points();
      for (int i = 0; i < nx; ++i)
        x_.store_point(i, &plane_[static_cast<std::size_t>(first) * nx + i], count, nx);
    });
    for_tiles(nx, y_.columns(), [&, nx = nx, ny = ny](int first, int count) {
      for (int j = 0; j < ny; ++j)
        y_.load_mode(j, &plane_[static_cast<std::size_t>(j) * nx + first], count);
      y_.to_points();
      for (int j = 0; j < ny; ++j)
        y_.store_point(j, points.row(j, k) + first, count);
    });
  }
}

void ComponentTransform::along_z(AlignedValues& modes, bool forward) {
  const int columns = layout_.count_x * layout_.count_y;
  const int nz = layout_.count_z;
  for_tiles(columns, z_.columns(), [&](int first, int count) {
    const auto at = [&](int k) { return &modes[static_cast<std::size_t>(k) * columns + first]; };
    for (int k = 0; k < nz; ++k)
      forward ? z_.load_point(k, at(k), count) : z_.load_mode(k, at(k), count);
    forward ? z_.to_modes() : z_.to_points();
    for (int k = 0; k < nz; ++k)
      forward ? z_.store_mode(k, at(k), count) : z_.store_point(k, at(k), count);
  });
}

/// Slabs of planes with all modes along x <-> all planes with this rank's modes along x. Blocks
/// arrive in the order of their planes, so what arrives needs no sorting.
void ComponentTransform::exchange(AlignedValues& from, AlignedValues& to, bool forward) const {
  const int ranks = parallel::size();
  std::vector<int> slab_counts(ranks), slab_begins(ranks), mode_counts(ranks), mode_begins(ranks);
  int slab_total = 0;
  int mode_total = 0;
  for (int r = 0; r < ranks; ++r) {
    slab_begins[r] = slab_total;
    mode_begins[r] = mode_total;
    slab_counts[r] = points_[2] * layouts_[r].count_x * points_[1];
    mode_counts[r] = planes_of_rank_[r] * layout_.count_x * points_[1];
    slab_total += slab_counts[r];
    mode_total += mode_counts[r];
  }
  if (!forward) {
    std::swap(slab_counts, mode_counts);
    std::swap(slab_begins, mode_begins);
  }
  MPI_Alltoallv(from.data(), slab_counts.data(), slab_begins.data(), MPI_DOUBLE, to.data(),
                mode_counts.data(), mode_begins.data(), MPI_DOUBLE, MPI_COMM_WORLD);
}

void ComponentTransform::to_modes(const Component& points, AlignedValues& modes) {
  if (parallel::size() == 1) {
    planes_to_modes(points, modes);
  } else {
    planes_to_modes(points, buffer_);
    exchange(buffer_, modes, true);
  }
  along_z(modes, true);
}

void ComponentTransform::to_points(const AlignedValues& modes, Component& points) {
  work_ = modes;
  along_z(work_, false);
  if (parallel::size() == 1) {
    planes_to_points(work_, points);
  } else {
    exchange(work_, buffer_, false);
    planes_to_points(buffer_, points);
  }
}

BoxTransform::BoxTransform(const Grid& grid, const Slab& slab)
    : grid_(grid),
      transform_{ComponentTransform(grid, slab, 0), ComponentTransform(grid, slab, 1),
                 ComponentTransform(grid, slab, 2)} {}

void BoxTransform::to_modes(const FaceField& points, ModeField& modes) {
  for (int c = 0; c < 3; ++c)
    transform_[c].to_modes(points.component[c], modes[c]);
}

void BoxTransform::to_points(const ModeField& modes, FaceField& points) {
  for (int c = 0; c < 3; ++c)
    transform_[c].to_points(modes[c], points.component[c]);
}

ModeField BoxTransform::zero_modes() const {
  return {AlignedValues(layout(0).size()), AlignedValues(layout(1).size()),
          AlignedValues(layout(2).size())};
}

namespace {

/// Calls row(all, piece) with the offsets of each row of y modes in the order of the whole box (z,
/// x, y) and in the concatenation of the ranks' pieces.
template <class Row>
void for_mode_rows(const Grid& grid, int c, const Row& row) {
  std::size_t piece = 0;
  for (int rank = 0; rank < parallel::size(); ++rank) {
    const ModeLayout l(grid, c, rank, parallel::size());
    const int x_begin = l.first_x - (c == 0 ? 0 : 1);
    for (int z = 0; z < l.count_z; ++z) {
      for (int x = 0; x < l.count_x; ++x, piece += l.count_y) {
        const std::size_t row_of_box =
            static_cast<std::size_t>(z) * grid.points(c, 0) + x_begin + x;
        row(row_of_box * l.count_y, piece);
      }
    }
  }
}

}  // namespace

std::vector<double> BoxTransform::gather(const ModeField& modes, int c) const {
  const std::vector<double> pieces = parallel::gather(modes[c]);
  std::vector<double> all(pieces.size());
  if (parallel::is_root())
    for_mode_rows(grid_, c, [&](std::size_t in_box, std::size_t in_pieces) {
      std::copy_n(pieces.data() + in_pieces, layout(c).count_y, all.data() + in_box);
    });
  return all;
}

void BoxTransform::scatter(std::span<const double> all, int c, ModeField& modes) const {
  std::vector<double> pieces(all.size());
  if (parallel::is_root())
    for_mode_rows(grid_, c, [&](std::size_t in_box, std::size_t in_pieces) {
      std::copy_n(all.data() + in_box, layout(c).count_y, pieces.data() + in_pieces);
    });
  const std::vector<double> mine = parallel::scatter(pieces, layout(c).size());
  modes[c].assign(mine.begin(), mine.end());
}

}  // namespace lv::fluid
