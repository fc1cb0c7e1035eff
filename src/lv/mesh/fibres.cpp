#include "lv/mesh/fibres.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace lv::mesh {

WallAxes wall_axes(const Vec3& transmural_gradient) {
  WallAxes axes;
  axes.radial = transmural_gradient.normalized();
  Vec3 along = Vec3::UnitZ() - axes.radial.z() * axes.radial;
  if (along.norm() < 1e-9)
    along = Vec3::UnitX() - axes.radial.x() * axes.radial;
  axes.longitudinal = along.normalized();
  axes.circumferential = axes.longitudinal.cross(axes.radial);
  return axes;
}

Mat3 fibre_frame(const FibreRule& rule, const WallAxes& axes, double t) {
  const double helix = (1.0 - t) * rule.helix_endo + t * rule.helix_epi;
  const double sheet = (1.0 - t) * rule.sheet_endo + t * rule.sheet_epi;
  const Vec3 f0 = std::cos(helix) * axes.circumferential - std::sin(helix) * axes.longitudinal;
  const Vec3 across = std::cos(sheet) * axes.radial + std::sin(sheet) * axes.longitudinal;
  const Vec3 s0 = (across - across.dot(f0) * f0).normalized();
  Mat3 frame;
  frame << f0, s0, f0.cross(s0);
  return frame;
}

double helix_angle(const Vec3& f0, const WallAxes& axes) {
  double angle = std::atan2(-f0.dot(axes.longitudinal), f0.dot(axes.circumferential));
  if (angle > std::numbers::pi / 2)
    angle -= std::numbers::pi;
  if (angle <= -std::numbers::pi / 2)
    angle += std::numbers::pi;
  return angle;
}

}  // namespace lv::mesh
