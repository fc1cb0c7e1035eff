#include "lv/solid/cavity.hpp"

#include <Eigen/Geometry>

namespace lv::solid {
namespace {

/// Six times the volume of the tetrahedron between the origin and a triangle.
double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c) {
  return a.dot(b.cross(c));
}

}  // namespace

Cavity::Cavity(const mesh::Mesh& mesh)
    : endo_(mesh::sides(mesh, mesh.endo)),
      shapes_(side_shapes(mesh.kind, mesh.order)),
      edge_(mesh::boundary_edges(mesh.endo)) {}

/// The divergence theorem, V = - int x.n da / 3; the quadrature is exact for the sides'
/// polynomials.
double Cavity::volume(std::span<const Vec3> positions) const {
  double six_V = 0.0;
  Eigen::Matrix3Xd x(3, endo_.nodes_per_element);
  for (int f = 0; f < endo_.size(); ++f) {
    const auto nodes = endo_.element(f);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      x.col(static_cast<Eigen::Index>(a)) = positions[nodes[a]];
    for (int q = 0; q < shapes_.points(); ++q) {
      const Eigen::Matrix<double, 3, 2> x_xi = x * shapes_.gradient[q].transpose();
      const Vec3 at = x * shapes_.value.row(q).transpose();
      six_V -= 2.0 * shapes_.weight[q] * at.dot(x_xi.col(0).cross(x_xi.col(1)));
    }
  }
  Vec3 centre = Vec3::Zero();
  for (const auto& side : edge_)
    centre += positions[side[0]] / static_cast<double>(edge_.size());
  for (const auto& side : edge_)
    six_V -= six_volumes(positions[side[1]], positions[side[0]], centre);
  return six_V / 6.0;
}

}  // namespace lv::solid
