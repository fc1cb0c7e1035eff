#include "lv/solid/boundary.hpp"

#include "lv/base/parallel.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace lv::solid {
namespace {

/// Calls point(phi, normal) at the quadrature points of one face, phi the shape functions and
/// normal = n da.
template <class Point>
void for_face_points(std::span<const int> face, std::span<const Vec3> x, const Point& point) {
  if (face.size() == 3) {
    const Vec3 normal = 0.5 * (x[face[1]] - x[face[0]]).cross(x[face[2]] - x[face[0]]);
    point(std::array<double, 4>{1.0 / 3, 1.0 / 3, 1.0 / 3, 0.0}, normal);
    return;
  }
  constexpr double g = 0.57735026918962576;  // 1/sqrt(3)
  for (const double s : {-g, g}) {
    for (const double t : {-g, g}) {
      const std::array<double, 4> phi{0.25 * (1 - s) * (1 - t), 0.25 * (1 + s) * (1 - t),
                                      0.25 * (1 + s) * (1 + t), 0.25 * (1 - s) * (1 + t)};
      const Vec3 along_s =
          0.25 * ((1 - t) * (x[face[1]] - x[face[0]]) + (1 + t) * (x[face[2]] - x[face[3]]));
      const Vec3 along_t =
          0.25 * ((1 - s) * (x[face[3]] - x[face[0]]) + (1 + s) * (x[face[2]] - x[face[1]]));
      point(phi, along_s.cross(along_t));
    }
  }
}

}  // namespace

void add_pressure_forces(const mesh::Surface& surface, double pressure,
                         std::span<const Vec3> positions, std::span<Vec3> forces) {
  const auto share = parallel::share(surface.size(), parallel::rank(), parallel::size());
  for (int f = share.begin; f < share.end; ++f) {
    const auto face = surface.face(f);
    for_face_points(face, positions, [&](const std::array<double, 4>& phi, const Vec3& normal) {
      for (std::size_t a = 0; a < face.size(); ++a)
        forces[face[a]] -= pressure * phi[a] * normal;
    });
  }
}

BasalPenalty::BasalPenalty(const mesh::Mesh& mesh, const BasalSupport& support) {
  std::map<int, double> area;
  for (int f = 0; f < mesh.base.size(); ++f) {
    const auto face = mesh.base.face(f);
    for_face_points(face, mesh.nodes, [&](const std::array<double, 4>& phi, const Vec3& normal) {
      for (std::size_t a = 0; a < face.size(); ++a)
        area[face[a]] += phi[a] * normal.norm();
    });
  }
  for (const auto& [node, A] : area) {
    const Vec3& X = mesh.nodes[node];
    Mat3 held = Mat3::Identity();
    if (support.kind == BasalSupport::Kind::sliding) {
      const Vec3 e_r = Vec3(X.x(), X.y(), 0.0).normalized();
      held -= e_r * e_r.transpose();
    }
    springs_.push_back({node, support.stiffness * A * held, X});
  }
}

void BasalPenalty::add_forces(std::span<const Vec3> positions, std::span<Vec3> forces) const {
  const auto share =
      parallel::share(static_cast<int>(springs_.size()), parallel::rank(), parallel::size());
  for (int i = share.begin; i < share.end; ++i) {
    const Spring& s = springs_[i];
    forces[s.node] -= s.stiffness * (positions[s.node] - s.reference);
  }
}

double BasalPenalty::largest_axial_displacement(std::span<const Vec3> positions) const {
  double largest = 0.0;
  for (const Spring& s : springs_)
    largest = std::max(largest, std::abs(positions[s.node].z() - s.reference.z()));
  return largest;
}

}  // namespace lv::solid
