#pragma once

#include <Eigen/Core>

#include <vector>

namespace lv::geometry {

/// A closed line in a plane; the last point is joined to the first.
using Polygon = std::vector<Eigen::Vector2d>;

/// Whether a ray from the point crosses the line an odd number of times.
[[nodiscard]] bool encloses(const Polygon& polygon, const Eigen::Vector2d& point);

/// How far out a ray from the origin last crosses the line, in
/// lengths of the ray; 0 if it never does.
[[nodiscard]] double farthest_crossing(const Polygon& polygon, const Eigen::Vector2d& ray);

}  // namespace lv::geometry
