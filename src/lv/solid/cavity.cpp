#include "lv/solid/cavity.hpp"

#include <Eigen/Geometry>

namespace lv::solid {
namespace {

/// Six times the volume of the tetrahedron between the origin and a triangle.
double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c) {
  return a.dot(b.cross(c));
}

}  // namespace

Cavity::Cavity(const mesh::Mesh& mesh) : endo_(mesh.endo), edge_(mesh::boundary_edges(mesh.endo)) {}

/// The divergence theorem over the faces. A bilinear face counts as the mean of its two ways to be
/// cut into triangles, which is exact for it.
double Cavity::volume(std::span<const Vec3> positions) const {
  const auto x = positions;
  double six_V = 0.0;
  for (int f = 0; f < endo_.size(); ++f) {
    const auto n = endo_.face(f);
    if (n.size() == 3) {
      six_V -= six_volumes(x[n[0]], x[n[1]], x[n[2]]);
      continue;
    }
    six_V -=
        0.5 * (six_volumes(x[n[0]], x[n[1]], x[n[2]]) + six_volumes(x[n[0]], x[n[2]], x[n[3]]) +
               six_volumes(x[n[0]], x[n[1]], x[n[3]]) + six_volumes(x[n[1]], x[n[2]], x[n[3]]));
  }
  Vec3 centre = Vec3::Zero();
  for (const auto& side : edge_)
    centre += x[side[0]] / static_cast<double>(edge_.size());
  for (const auto& side : edge_)
    six_V -= six_volumes(x[side[1]], x[side[0]], centre);
  return six_V / 6.0;
}

}  // namespace lv::solid
