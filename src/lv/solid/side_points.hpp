#pragma once

#include "lv/solid/shape_table.hpp"

#include <Eigen/Geometry>

#include <span>

namespace lv::solid {

/// A quadrature point of a side.
struct SidePoint {
  int q = 0;
  Vec3 x = Vec3::Zero();
  Vec3 x_s = Vec3::Zero(), x_t = Vec3::Zero();  ///< derivatives by the reference coordinates

  /// n da over the rule's weight.
  [[nodiscard]] Vec3 normal() const { return x_s.cross(x_t); }
};

/// Calls visit(point) for the quadrature points of the side with these nodes.
template <class Visit>
void for_side_points(const ShapeTable& shapes, std::span<const int> nodes,
                     std::span<const Vec3> positions, const Visit& visit) {
  for (int q = 0; q < shapes.points(); ++q) {
    const Eigen::MatrixXd& gradient = shapes.gradient[q];
    SidePoint point{.q = q};
    for (int a = 0; a < static_cast<int>(nodes.size()); ++a) {
      const Vec3& x = positions[nodes[a]];
      point.x += shapes.value(q, a) * x;
      point.x_s += gradient(0, a) * x;
      point.x_t += gradient(1, a) * x;
    }
    visit(point);
  }
}

}  // namespace lv::solid
