#include "lv/solid/base_motion.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace lv::solid {

BaseFrame base_frame(const mesh::Mesh& mesh, double septum_angle) {
  const std::vector<int> nodes = mesh::surface_nodes(mesh.base);
  Vec3 middle = Vec3::Zero();
  for (const int node : nodes)
    middle += mesh.nodes[node] / static_cast<double>(nodes.size());
  return {middle, septum_angle};
}

AffineField displacement(const BasePose& pose, const BaseFrame& frame) {
  const Vec3 septum(std::cos(frame.septum_angle), std::sin(frame.septum_angle), 0.0);
  const Vec3 anterior = Vec3::UnitZ().cross(septum);
  const Vec3 turn =
      pose.septal_tilt * anterior - pose.anterior_tilt * septum - pose.rotation * Vec3::UnitZ();
  const double angle = turn.norm();
  AffineField u;
  if (angle > 0.0)
    u.H = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() - Mat3::Identity();
  u.d = -pose.axial * Vec3::UnitZ() - u.H * frame.middle;
  return u;
}

}  // namespace lv::solid
