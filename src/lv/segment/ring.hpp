#pragma once

#include "lv/segment/polar.hpp"

#include <optional>

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

}  // namespace lv::segment
