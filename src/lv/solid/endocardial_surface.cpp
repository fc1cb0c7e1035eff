#include "lv/solid/endocardial_surface.hpp"

#include "lv/base/parallel.hpp"
#include "lv/solid/side_points.hpp"

namespace lv::solid {

EndocardialSurface::EndocardialSurface(const mesh::Mesh& mesh, const mesh::Surface& surface)
    : sides_(mesh::sides(mesh.kind, mesh.order, surface)),
      shapes_(side_shapes(mesh.kind, mesh.order)) {
  for (const auto& side : mesh::boundary_edges(surface))
    edge_.push_back(side[0]);
}

Vec3 EndocardialSurface::centre_of_edge(std::span<const Vec3> positions) const {
  Vec3 c = Vec3::Zero();
  for (const int node : edge_)
    c += positions[node] / static_cast<double>(edge_.size());
  return c;
}

/// The quadrature is exact for the sides' polynomials.
double EndocardialSurface::volume(std::span<const Vec3> positions) const {
  const Vec3 c = centre_of_edge(positions);
  double three_V = 0.0;
  for (int f = 0; f < sides_.size(); ++f)
    for_side_points(shapes_, sides_.element(f), positions, [&](const SidePoint& point) {
      three_V -= shapes_.weight[point.q] * (point.x - c).dot(point.normal());
    });
  return three_V / 3.0;
}

/// Calls visit(nodes) for this rank's sides.
template <class Visit>
void EndocardialSurface::for_share(const Visit& visit) const {
  const auto share = parallel::share(sides_.size(), parallel::rank(), parallel::size());
  for (int f = share.begin; f < share.end; ++f)
    visit(sides_.element(f));
}

void EndocardialSurface::add_gradient(double factor, std::span<const Vec3> positions,
                                      std::span<Vec3> to) const {
  for_share([&](std::span<const int> nodes) {
    for_side_points(shapes_, nodes, positions, [&](const SidePoint& point) {
      const Vec3 n_da = factor * shapes_.weight[point.q] * point.normal();
      for (int a = 0; a < shapes_.nodes(); ++a)
        to[nodes[a]] -= shapes_.value(point.q, a) * n_da;
    });
  });
}

/// d[(x - c).(x_s cross x_t)] = dx.(x_s cross x_t) + dx_s.(x_t cross (x - c))
///                              + dx_t.((x - c) cross x_s) - dc.(x_s cross x_t)
void EndocardialSurface::add_volume_gradient(std::span<const Vec3> positions,
                                             std::span<Vec3> to) const {
  const Vec3 c = centre_of_edge(positions);
  Vec3 area = Vec3::Zero();  // int n da of the share
  for_share([&](std::span<const int> nodes) {
    for_side_points(shapes_, nodes, positions, [&](const SidePoint& point) {
      const Eigen::MatrixXd& gradient = shapes_.gradient[point.q];
      const double third = shapes_.weight[point.q] / 3.0;
      const Vec3 r = point.x - c;
      const Vec3 by_s = point.x_t.cross(r);
      const Vec3 by_t = r.cross(point.x_s);
      for (int a = 0; a < shapes_.nodes(); ++a)
        to[nodes[a]] -= third * (shapes_.value(point.q, a) * point.normal() +
                                 gradient(0, a) * by_s + gradient(1, a) * by_t);
      area += 3.0 * third * point.normal();
    });
  });
  for (const int node : edge_)
    to[node] += area / (3.0 * static_cast<double>(edge_.size()));
}

/// d(x_s cross x_t)/dx_b = [x_s x] d phi_b/dt - [x_t x] d phi_b/ds.
void EndocardialSurface::add_hessian(double factor, std::span<const Vec3> positions,
                                     const Block& add) const {
  const int n = shapes_.nodes();
  for_share([&](std::span<const int> nodes) {
    Eigen::MatrixXd block = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    for_side_points(shapes_, nodes, positions, [&](const SidePoint& point) {
      const Eigen::MatrixXd& gradient = shapes_.gradient[point.q];
      const Mat3 along_s = cross_matrix(point.x_s);
      const Mat3 along_t = cross_matrix(point.x_t);
      for (int b = 0; b < n; ++b) {
        const Mat3 d_normal = factor * shapes_.weight[point.q] *
                              (gradient(1, b) * along_s - gradient(0, b) * along_t);
        for (int a = 0; a < n; ++a)
          block.block<3, 3>(3 * a, 3 * b) -= shapes_.value(point.q, a) * d_normal;
      }
    });
    add(nodes, block);
  });
}

}  // namespace lv::solid
