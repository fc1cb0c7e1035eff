#pragma once

#include "lv/segment/polar.hpp"

#include <cmath>
#include <vector>

/// Points and lines that others drew, round the centre of a polar picture.
namespace lv::segment {

/// The ray nearest to an angle of (-pi, pi].
[[nodiscard]] inline int nearest_ray(double angle, int rays) {
  const auto ray = static_cast<int>(std::lround(angle / ray_angle(1, rays)));
  return (ray + rays) % rays;
}

/// A place round a centre.
struct PolarPoint {
  double angle = 0.0;   ///< from a picture's columns to its rows [rad]
  double radius = 0.0;  ///< [mm]
};

/// A point of a picture's plane round a centre.
[[nodiscard]] PolarPoint polar_of(const image::Plane& plane, const Pixel& centre, const Vec3& x);

/// The radii at which rays from the centre leave a closed line.
[[nodiscard]] Radii radii_of(const image::Plane& plane, const Pixel& centre,
                             const std::vector<Vec3>& line, int rays);

}  // namespace lv::segment
