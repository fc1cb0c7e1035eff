#include "lv/mesh/fibres.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/cell.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace lv::mesh {

WallAxes wall_axes(const Vec3& transmural_gradient) {
  LV_CHECK(transmural_gradient.squaredNorm() > 0.0);
  WallAxes axes;
  axes.radial = transmural_gradient.normalized();
  Vec3 along = Vec3::UnitZ() - axes.radial.z() * axes.radial;
  if (along.norm() < 1e-9)
    along = Vec3::UnitX() - axes.radial.x() * axes.radial;
  axes.longitudinal = along.normalized();
  axes.circumferential = axes.longitudinal.cross(axes.radial);
  return axes;
}

namespace {

/// Gives nodes without a direction the mean of those that share a cell with them. Whether any
/// received one.
bool fill_from_neighbours(const Mesh& mesh, std::vector<Vec3>& directions) {
  std::vector<Vec3> sum(directions.size(), Vec3::Zero());
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (const int a : mesh.cell(c))
      for (const int b : mesh.cell(c))
        sum[a] += directions[b];
  bool any = false;
  for (std::size_t a = 0; a < directions.size(); ++a) {
    if (directions[a] != Vec3::Zero() || sum[a].norm() < 1e-9)
      continue;
    directions[a] = sum[a].normalized();
    any = true;
  }
  return any;
}

}  // namespace

std::vector<Vec3> radial_directions(const Mesh& mesh) {
  std::vector<Vec3> radial(mesh.nodes.size(), Vec3::Zero());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const Vec3 gradient = cell_volume(mesh, c) * mean_gradient(mesh, c, mesh.transmural);
    for (const int node : mesh.cell(c))
      radial[node] += gradient;
  }
  const double least = 1e-9 * cell_volume(mesh, 0);
  for (Vec3& direction : radial)
    direction = direction.norm() > least ? direction.normalized() : Vec3::Zero().eval();
  while (fill_from_neighbours(mesh, radial)) {
  }
  return radial;
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
