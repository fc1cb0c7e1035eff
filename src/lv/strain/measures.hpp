#pragma once

#include "lv/geometry/contours.hpp"

#include <array>
#include <vector>

namespace lv::strain {

/// Overlap of what two loops in one plane enclose, 2 |A and B| / (|A| + |B|), by sampling a grid of
/// a quarter of a millimetre.
[[nodiscard]] double dice(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

/// Distances of a loop's points from a line [mm].
struct Distance {
  double mean = 0.0, rms = 0.0, largest = 0.0;
};
/// `lines` are chains of points; with `closed` their ends are joined. NaN without lines.
[[nodiscard]] Distance distance(const std::vector<Vec3>& points,
                                const std::vector<std::vector<Vec3>>& lines, bool closed);

/// The lines in which a plane cuts triangles: chains of points, closed ones end where they begin.
[[nodiscard]] std::vector<std::vector<Vec3>> cut(const std::vector<std::array<Vec3, 3>>& triangles,
                                                 const Vec3& point, const Vec3& normal);

}  // namespace lv::strain
