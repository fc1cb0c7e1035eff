#include "lv/solid/boundary.hpp"

#include "lv/base/parallel.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/solid/side_points.hpp"

#include <cmath>

namespace lv::solid {

std::map<int, double> nodal_areas(const mesh::Mesh& mesh, const mesh::Surface& surface) {
  std::map<int, double> area;
  const mesh::ElementNodes faces = mesh::sides(mesh.kind, 1, surface);
  const ShapeTable shapes = side_shapes(mesh.kind, 1);
  for (int f = 0; f < faces.size(); ++f) {
    const auto nodes = faces.element(f);
    for_side_points(shapes, nodes, mesh.nodes, [&](const SidePoint& point) {
      const double da = shapes.weight[point.q] * point.normal().norm();
      for (int a = 0; a < shapes.nodes(); ++a)
        area[nodes[a]] += shapes.value(point.q, a) * da;
    });
  }
  return area;
}

BasalPenalty::BasalPenalty(const mesh::Mesh& mesh, const BasalSupport& support) {
  if (support.kind == BasalSupport::Kind::elastic)
    return;
  for (const auto& [node, A] : nodal_areas(mesh, mesh.base)) {
    const Vec3& X = mesh.nodes[node];
    Mat3 held = Mat3::Identity();
    if (support.kind == BasalSupport::Kind::sliding) {
      const Vec3 e_r = Vec3(X.x(), X.y(), 0.0).normalized();
      held -= e_r * e_r.transpose();
    }
    springs_.push_back({node, support.stiffness * A * held, X});
  }
}

void BasalPenalty::add_forces(std::span<const Vec3> positions, std::span<Vec3> forces,
                              const AffineField& displacement) const {
  const auto share =
      parallel::share(static_cast<int>(springs_.size()), parallel::rank(), parallel::size());
  for (int i = share.begin; i < share.end; ++i) {
    const Spring& s = springs_[i];
    forces[s.node] -=
        s.stiffness * (positions[s.node] - s.reference - displacement.at(s.reference));
  }
}

}  // namespace lv::solid
