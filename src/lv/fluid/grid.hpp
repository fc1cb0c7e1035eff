#pragma once

#include "lv/base/parallel.hpp"
#include "lv/base/tensor.hpp"

#include <array>

namespace lv::fluid {

/// The uniform Cartesian grid of the box Omega, staggered (MAC): pressure at cell centres, velocity
/// component d at the faces normal to axis d. The paper: 15 x 15 x 20 cm in 96 x 96 x 128 cells
/// (section 2.5).
struct Grid {
  std::array<int, 3> cells{96, 96, 128};
  Vec3 lower = Vec3::Zero();                    ///< lower corner of the box [mm]
  Vec3 spacing = Vec3::Constant(150.0 / 96.0);  ///< cell size along each axis [mm]

  [[nodiscard]] double cell_volume() const { return spacing.prod(); }
  [[nodiscard]] Vec3 upper() const;

  /// Points of velocity component c along axis d: faces along its own axis, cell centres along the
  /// others.
  [[nodiscard]] int points(int c, int d) const { return cells[d] + (c == d ? 1 : 0); }

  /// Position of point (i, j, k) of velocity component c.
  [[nodiscard]] Vec3 face(int c, int i, int j, int k) const;
};

/// A box of this size [mm] in this many cells, about its centre.
[[nodiscard]] Grid centred_grid(const Vec3& centre, const Vec3& size,
                                const std::array<int, 3>& cells);

/// The part of the box that one rank owns: whole planes of cells along z.
struct Slab {
  parallel::Range planes;  ///< cell planes [begin, end)
  bool first = true;       ///< owns the plane at the lower end of the box
  bool last = true;        ///< owns the plane at the upper end of the box

  /// Planes of points of velocity component c on this rank; the last rank owns the box's upper
  /// face.
  [[nodiscard]] int points(int c) const { return planes.size() + (c == 2 && last ? 1 : 0); }
};

/// The slab of `rank` when the grid is shared by `ranks`.
/// Throws InputError when a slab would be thinner than the two planes that its neighbours need.
/// See slab_of.
[[nodiscard]] int most_ranks(const std::array<int, 3>& cells);

[[nodiscard]] Slab slab_of(const Grid& grid, int rank, int ranks);

}  // namespace lv::fluid
