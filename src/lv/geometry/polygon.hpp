#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace lv::geometry {

/// A closed line in a plane; the last point is joined to the first.
using Polygon = std::vector<Eigen::Vector2d>;

/// Whether a ray from the point crosses the line an odd number of times.
[[nodiscard]] bool encloses(const Polygon& polygon, const Eigen::Vector2d& point);

/// How far out a ray from the origin last crosses the line, in
/// lengths of the ray; 0 if it never does.
[[nodiscard]] double farthest_crossing(const Polygon& polygon, const Eigen::Vector2d& ray);

/// From a point to the nearest of a segment, in a plane or in space.
template <class Point>
[[nodiscard]] double distance_to_segment(const Point& x, const Point& a, const Point& b) {
  const Point ab = b - a;
  const double t = std::clamp((x - a).dot(ab) / std::max(ab.squaredNorm(), 1e-12), 0.0, 1.0);
  return (x - a - t * ab).norm();
}

}  // namespace lv::geometry
