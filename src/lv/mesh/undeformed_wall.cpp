#include "lv/mesh/undeformed_wall.hpp"

#include "lv/mesh/cell.hpp"

#include <Eigen/LU>

#include <algorithm>

namespace lv::mesh {

UndeformedWall::UndeformedWall(const Mesh& mesh)
    : mesh_(mesh),
      radial_(mesh.kind == CellKind::tetrahedron ? radial_directions(mesh) : std::vector<Vec3>{}) {}

WallAxes UndeformedWall::axes(std::span<const int> nodes, std::span<const double> phi,
                              const Vec3& gradient_of_t) const {
  if (radial_.empty())
    return wall_axes(gradient_of_t);
  Vec3 radial = Vec3::Zero();
  for (std::size_t a = 0; a < nodes.size(); ++a)
    radial += phi[a] * radial_[nodes[a]];
  return wall_axes(radial);
}

UndeformedPoint UndeformedWall::at(const ElementPoint& point) const {
  const auto& [cell, nodes, phi, gradient] = point;
  UndeformedPoint result{jacobian(mesh_, point), 0.0, Vec3::Zero(), 0.0, 0.0, {}, {}};
  Vec3 dt_dxi = Vec3::Zero();
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    result.X += phi[a] * mesh_.nodes[nodes[a]];
    result.t += phi[a] * mesh_.transmural[nodes[a]];
    result.M += phi[a] * mesh_.infarct[nodes[a]];
    dt_dxi += mesh_.transmural[nodes[a]] * Vec3(gradient.data() + 3 * a);
  }
  result.M = std::clamp(result.M, 0.0, 1.0);
  result.det = result.dX_dxi.determinant();
  if (!(result.det > 0.0))
    fail_inverted(cell, result.det, result.X);
  result.axes = axes(nodes, phi, result.dX_dxi.inverse().transpose() * dt_dxi);
  result.frame = fibre_frame(mesh_, {cell, nodes, phi, result.axes, result.t});
  return result;
}

Mat3 UndeformedWall::frame_of_cell(int cell) const {
  const auto nodes = mesh_.cell(cell);
  const std::vector<double> phi(nodes.size(), 1.0 / static_cast<double>(nodes.size()));
  double t = 0.0;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    t += phi[a] * mesh_.transmural[nodes[a]];
  return fibre_frame(
      mesh_, {cell, nodes, phi, axes(nodes, phi, mean_gradient(mesh_, cell, mesh_.transmural)), t});
}

}  // namespace lv::mesh
