#include "lv/solid/support.hpp"

#include "lv/base/parallel.hpp"
#include "lv/mesh/mesh.hpp"
#include "lv/solid/side_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lv::solid {
namespace {

/// The height of a place on a surface, from 0 at its lowest node to 1 at its highest.
class Height {
 public:
  Height(const mesh::Mesh& mesh, const mesh::Surface& surface) {
    for (const int node : surface.nodes) {
      low_ = std::min(low_, mesh.nodes[node].z());
      high_ = std::max(high_, mesh.nodes[node].z());
    }
  }

  [[nodiscard]] double at(double z) const {
    return high_ > low_ ? (z - low_) / (high_ - low_) : 0.0;
  }

 private:
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

Eigen::VectorXd gather(std::span<const Vec3> values, std::span<const int> nodes) {
  Eigen::VectorXd result(3 * static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t a = 0; a < nodes.size(); ++a)
    result.segment<3>(3 * static_cast<Eigen::Index>(a)) = values[nodes[a]];
  return result;
}

/// Adds w phi_a phi_b K at a point, 3 x 3 blocks.
void add_products(const ShapeTable& shapes, int q, double w, const Mat3& K, Eigen::MatrixXd& sum) {
  for (int a = 0; a < shapes.nodes(); ++a)
    for (int b = 0; b < shapes.nodes(); ++b)
      sum.block<3, 3>(3 * a, 3 * b) += w * shapes.value(q, a) * shapes.value(q, b) * K;
}

/// A field at places X, three rows for each.
Eigen::VectorXd field_at(const AffineField& field, const Eigen::VectorXd& X) {
  Eigen::VectorXd result(X.size());
  for (Eigen::Index i = 0; i < X.size(); i += 3)
    result.segment<3>(i) = field.at(X.segment<3>(i));
  return result;
}

}  // namespace

double AxialWeight::at(double h) const {
  const double s = shape == WeightShape::even ? 1.0
                   : shape == WeightShape::linear
                       ? 1.0 - h
                       : 1.0 / (1.0 + std::exp(steepness * (h - middle)));
  return at_base + (1.0 - at_base) * s;
}

double Surroundings::longest_step(double mass) const {
  double k = 0.0;
  double c = 0.0;
  for (const Support* s : {&epicardium, &base}) {
    const double most = std::max(1.0, s->weight.at_base);  // of the weight
    k += most * std::max(s->normal_stiffness, s->tangential_stiffness) / mass;
    c += most * std::max(s->normal_viscosity, s->tangential_viscosity) / mass;
  }
  if (k == 0.0 && c == 0.0)
    return std::numeric_limits<double>::infinity();
  return 4.0 / (c + std::sqrt(c * c + 4.0 * k));
}

SupportedSurface::SupportedSurface(const mesh::Mesh& mesh, const mesh::Surface& surface,
                                   const Support& support) {
  if (support.is_none())
    return;
  const Height height(mesh, surface);
  const mesh::ElementNodes sides = mesh::sides(mesh.kind, mesh.order, surface);
  const ShapeTable shapes = side_shapes(mesh.kind, mesh.order);
  const int n = shapes.nodes();
  const auto share = parallel::share(sides.size(), parallel::rank(), parallel::size());
  for (int f = share.begin; f < share.end; ++f) {
    const auto nodes = sides.element(f);
    Side side{{nodes.begin(), nodes.end()},
              Eigen::MatrixXd::Zero(3 * n, 3 * n),
              Eigen::MatrixXd::Zero(3 * n, 3 * n),
              gather(mesh.nodes, nodes)};
    for_side_points(shapes, nodes, mesh.nodes, [&](const SidePoint& point) {
      const double dA = shapes.weight[point.q] * point.normal().norm();
      const Vec3 N = point.normal().normalized();
      const Mat3 on_normal = N * N.transpose();
      const Mat3 along = support.scatter ? Mat3(on_normal + support.scatter(point.x)) : on_normal;
      const Mat3 across = Mat3::Identity() - on_normal;
      const double w = support.weight.at(height.at(point.x.z())) * dA;
      add_products(shapes, point.q, w,
                   support.normal_stiffness * along + support.tangential_stiffness * across,
                   side.stiffness);
      add_products(shapes, point.q, w,
                   support.normal_viscosity * along + support.tangential_viscosity * across,
                   side.viscosity);
    });
    sides_.push_back(std::move(side));
  }
}

void SupportedSurface::add_forces(std::span<const Vec3> positions, std::span<const Vec3> velocities,
                                  std::span<Vec3> forces, const BasePlace& place) const {
  for (const Side& side : sides_) {
    Eigen::VectorXd force = side.stiffness * (gather(positions, side.nodes) - side.reference -
                                              field_at(place.displacement, side.reference));
    if (!velocities.empty())
      force += side.viscosity *
               (gather(velocities, side.nodes) - field_at(place.velocity, side.reference));
    for (std::size_t a = 0; a < side.nodes.size(); ++a)
      forces[side.nodes[a]] -= force.segment<3>(3 * static_cast<Eigen::Index>(a));
  }
}

void SupportedSurface::add_stiffness(double slope, const EndocardialSurface::Block& add) const {
  for (const Side& side : sides_)
    add(side.nodes, side.stiffness + slope * side.viscosity);
}

Supports::Supports(const mesh::Mesh& mesh, const BasalSupport& base,
                   const Surroundings& surroundings)
    : springs_(mesh, base),
      epicardium_(mesh, mesh.epi, surroundings.epicardium),
      base_(mesh, mesh.base, surroundings.base) {}

void Supports::add_forces(std::span<const Vec3> positions, std::span<const Vec3> velocities,
                          std::span<Vec3> forces, const BasePlace& place) const {
  epicardium_.add_forces(positions, velocities, forces);
  add_base_forces(positions, velocities, forces, place);
}

void Supports::add_base_forces(std::span<const Vec3> positions, std::span<const Vec3> velocities,
                               std::span<Vec3> forces, const BasePlace& place) const {
  springs_.add_forces(positions, forces, place.displacement);
  base_.add_forces(positions, velocities, forces, place);
}

void Supports::add_stiffness(double slope, const EndocardialSurface::Block& add) const {
  epicardium_.add_stiffness(slope, add);
  base_.add_stiffness(slope, add);
  if (parallel::is_root())
    for (const auto& spring : springs_.springs())
      add(std::array{spring.node}, spring.stiffness);
}

}  // namespace lv::solid
