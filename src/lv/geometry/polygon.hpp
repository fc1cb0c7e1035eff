#pragma once

#include <Eigen/Core>

#include <vector>

namespace lv::geometry {

/// A closed line in a plane; the last point is joined to the first.
using Polygon = std::vector<Eigen::Vector2d>;

/// Whether a ray from the point crosses the line an odd number of times.
[[nodiscard]] bool encloses(const Polygon& polygon, const Eigen::Vector2d& point);

}  // namespace lv::geometry
