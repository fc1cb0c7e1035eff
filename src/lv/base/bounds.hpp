#pragma once

#include "lv/base/tensor.hpp"

#include <Eigen/Geometry>

#include <span>

namespace lv {

/// The smallest box along the axes that holds all points.
inline Eigen::AlignedBox3d bounds(std::span<const Vec3> points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : points)
    box.extend(x);
  return box;
}

}  // namespace lv
