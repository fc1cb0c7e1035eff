#pragma once

#include "lv/base/tensor.hpp"

#include <span>

namespace lv::mesh {

struct Plane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();

  /// On the side of the normal > 0.
  [[nodiscard]] double height(const Vec3& x) const { return normal.dot(x - point); }
};

/// The plane through the points' mean with the least sum of squared distances. The sign of its
/// normal is arbitrary.
[[nodiscard]] Plane fit_plane(std::span<const Vec3> points);

}  // namespace lv::mesh
