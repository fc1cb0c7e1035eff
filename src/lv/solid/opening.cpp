#include "lv/solid/opening.hpp"

#include "lv/solid/boundary.hpp"

#include <Eigen/LU>

namespace lv::solid {
namespace {

using Vec2 = Eigen::Vector2d;

Vec2 in_plane(const Vec3& X) {
  return X.head<2>();
}

/// The centre of the area within the edge, as triangles around the mean of its nodes.
Vec3 centre_within(const mesh::Mesh& mesh, const std::vector<std::array<int, 2>>& edge) {
  Vec3 middle = Vec3::Zero();
  for (const auto& side : edge)
    middle += mesh.nodes[side[0]] / static_cast<double>(edge.size());
  Vec3 moment = Vec3::Zero();
  double area = 0.0;
  for (const auto& [a, b] : edge) {
    const Vec3 to_a = mesh.nodes[a] - middle;
    const Vec3 to_b = mesh.nodes[b] - middle;
    const double A = 0.5 * to_a.cross(to_b).z();  // negative where the edge turns back
    moment += A / 3.0 * (to_a + to_b);
    area += A;
  }
  return middle + moment / area;
}

}  // namespace

Opening::Opening(const mesh::Mesh& mesh) {
  const auto edge = mesh::boundary_edges(mesh.endo);
  if (edge.empty() || mesh.base.size() == 0)
    return;
  centre_ = centre_within(mesh, edge);
  const std::map<int, double> areas = nodal_areas(mesh, mesh.base);
  double A = 0.0;
  Vec2 B = Vec2::Zero();
  for (const auto& [node, share] : areas) {
    A += share;
    B += share * in_plane(mesh.nodes[node]);
  }
  B /= A;
  Eigen::Matrix2d M = Eigen::Matrix2d::Zero();
  for (const auto& [node, share] : areas) {
    const Vec2 arm = in_plane(mesh.nodes[node]) - B;
    M += share * arm * arm.transpose();
  }
  const Vec2 slope = M.inverse() * (in_plane(centre_) - B);
  for (const auto& [node, share] : areas)
    weights_.push_back({node, share * (1.0 / A + slope.dot(in_plane(mesh.nodes[node]) - B))});
}

Vec3 Opening::carried(std::span<const Vec3> at_nodes) const {
  Vec3 sum = Vec3::Zero();
  for (const Weight& weight : weights_)
    sum += weight.w * at_nodes[weight.node];
  return sum;
}

}  // namespace lv::solid
