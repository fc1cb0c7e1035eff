#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/geometry/frame.hpp"

#include <span>
#include <string>
#include <vector>

namespace lv::geometry {

[[nodiscard]] Vec3 mean_of(std::span<const Vec3> points);

/// The least-squares plane of some points: origin in their mean, z along the normal.
[[nodiscard]] Frame plane_of(std::span<const Vec3> points);

/// The mean distance of a loop's points from their mean [mm].
[[nodiscard]] double mean_radius(const Contour& loop);

/// The area that a closed loop encloses, projected on its plane [mm^2].
[[nodiscard]] double enclosed_area(const Contour& loop);

/// The length of line that each point stands for: half of the segments on either side [mm].
[[nodiscard]] std::vector<double> point_lengths(const Contour& contour, bool closed);

/// "slice 3, endo", for messages.
[[nodiscard]] std::string label(const Contour& contour);

}  // namespace lv::geometry
