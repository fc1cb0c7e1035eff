#include "lv/mesh/fibres.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/cell.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <array>
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

namespace {

/// The direction in the wall across the fibres that the rule's sheets have: not yet normal to them.
Vec3 rule_sheet(const FibreRule& rule, const WallAxes& axes, double t) {
  const double sheet = (1.0 - t) * rule.sheet_endo + t * rule.sheet_epi;
  return std::cos(sheet) * axes.radial + std::sin(sheet) * axes.longitudinal;
}

/// Columns f0, the part of `across` normal to f0, and their normal.
Mat3 frame_of(const Vec3& f0, const Vec3& across) {
  const Vec3 s0 = (across - across.dot(f0) * f0).normalized();
  Mat3 frame;
  frame << f0, s0, f0.cross(s0);
  return frame;
}

/// The mean of the directions that a mesh brings at a point.
Vec3 direction_at(const GivenFibres& fibres, const std::vector<Vec3>& directions,
                  const WallPoint& point) {
  if (fibres.at == GivenFibres::At::cells)
    return directions[point.cell];
  std::vector<Vec3> at_nodes;
  for (const int node : point.nodes)
    at_nodes.push_back(directions[node]);
  return mean_direction(at_nodes, point.phi);
}

/// Directions that turn with the cells of a mesh which moves.
class Turning {
 public:
  Turning(const Mesh& mesh, const std::vector<Vec3>& nodes) {
    std::array<std::vector<double>, 3> x;
    for (const Vec3& node : nodes)
      for (int d = 0; d < 3; ++d)
        x[d].push_back(node[d]);
    for (int c = 0; c < mesh.cell_count(); ++c) {
      F_.emplace_back();
      for (int d = 0; d < 3; ++d)
        F_.back().row(d) = mean_gradient(mesh, c, x[d]);
    }
    if (mesh.fibres.given.at == GivenFibres::At::nodes)
      spread_to_nodes(mesh);
  }

  void turn(std::vector<Vec3>& directions) const {
    for (std::size_t i = 0; i < directions.size(); ++i)
      directions[i] = (F_[i] * directions[i]).normalized();
  }

 private:
  void spread_to_nodes(const Mesh& mesh) {
    std::vector<Mat3> sum(mesh.nodes.size(), Mat3::Zero());
    for (int c = 0; c < mesh.cell_count(); ++c)
      for (const int node : mesh.cell(c))
        sum[node] += cell_volume(mesh, c) * F_[c];  // of any length: directions alone are asked for
    F_ = std::move(sum);
  }

  std::vector<Mat3> F_;  ///< where the directions stand
};

}  // namespace

Mat3 fibre_frame(const FibreRule& rule, const WallAxes& axes, double t) {
  const double helix = (1.0 - t) * rule.helix_endo + t * rule.helix_epi;
  const Vec3 f0 = std::cos(helix) * axes.circumferential - std::sin(helix) * axes.longitudinal;
  return frame_of(f0, rule_sheet(rule, axes, t));
}

Mat3 fibre_frame(const Mesh& mesh, const WallPoint& point) {
  const auto& [rule, given] = mesh.fibres;
  if (given.f0.empty())
    return fibre_frame(rule, point.axes, point.t);
  const Vec3 f0 = direction_at(given, given.f0, point);
  const Vec3 wanted = given.s0.empty() ? rule_sheet(rule, point.axes, point.t)
                                       : direction_at(given, given.s0, point);
  // where fibres run along the sheets that are wanted, any other direction serves
  const Vec3 other = wall_axes(f0).longitudinal;
  constexpr double least = 1e-3;
  return frame_of(f0, wanted.cross(f0).norm() > least ? wanted : other);
}

Vec3 mean_direction(std::span<const Vec3> directions, std::span<const double> weights) {
  Mat3 sum = Mat3::Zero();
  for (std::size_t i = 0; i < directions.size(); ++i)
    sum += weights[i] * directions[i] * directions[i].transpose();
  return Eigen::SelfAdjointEigenSolver<Mat3>(sum).eigenvectors().col(2);
}

Mesh with_nodes(const Mesh& mesh, std::vector<Vec3> nodes) {
  Mesh moved = mesh;
  if (!mesh.fibres.given.f0.empty()) {
    const Turning turning(mesh, nodes);
    turning.turn(moved.fibres.given.f0);
    turning.turn(moved.fibres.given.s0);
  }
  moved.nodes = std::move(nodes);
  return moved;
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
