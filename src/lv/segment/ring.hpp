#pragma once

#include "lv/segment/closed_path.hpp"

#include <optional>
#include <vector>

namespace lv::segment {

/// Where along each ray the first dark layer within a border ends, if a ring of them lies within
/// it: a border that is sought round blood then runs round something bright outside the wall, as
/// fluid or fat.
///
/// A layer is 4 mm deep or more, of darkness (0 blood, 1 muscle) above 0.5, and ends 1 mm or more
/// before the border. Layers make a ring if three quarters of the rays have one: papillary muscles
/// do not. A ray without one has the grid's last radius. None without a ring.
[[nodiscard]] std::optional<Radii> ring_within(const Polar& darkness, const Radii& border,
                                               const PolarGrid& grid);

/// The closed path of least cost; where it runs outside a ring (ring_within), that of least cost
/// when every radius beyond the ring costs so much more.
[[nodiscard]] Radii path_within_ring(const Polar& cost, const Polar& darkness, double beyond,
                                     const PathRule& rule, const PolarGrid& grid,
                                     const std::vector<Fixed>& fixed = {});

}  // namespace lv::segment
