#include "lv/immersed/quadrature_coupling.hpp"

#include "lv/base/parallel.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/gauss.hpp"
#include "lv/solid/element.hpp"

#include <Eigen/LU>

#include <algorithm>

namespace lv::immersed {
namespace {

template <class Point, class Shapes>
void set_shapes(Point& point, const Shapes& shapes) {
  std::copy(shapes.value.begin(), shapes.value.end(), point.phi.begin());
  std::copy(shapes.gradient.begin(), shapes.gradient.end(), point.gradient.begin());
}

}  // namespace

QuadratureCoupling::QuadratureCoupling(const mesh::Mesh& mesh, const Transfer& transfer,
                                       double spacing, double points_per_cell)
    : mesh_(mesh),
      transfer_(transfer),
      spacing_(spacing),
      points_per_cell_(points_per_cell),
      mass_(static_cast<Eigen::Index>(mesh.nodes.size()),
            static_cast<Eigen::Index>(mesh.nodes.size())) {
  assemble_mass();
  solver_.setTolerance(1e-12);  // so that spreading and interpolation are adjoint to rounding
  solver_.compute(mass_);
}

void QuadratureCoupling::assemble_mass() {
  const Rule& exact = rule({3, 3, 3});  // phi phi det has degree four in a coordinate
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    const auto cell = mesh_.cell(c);
    for (const ReferencePoint& point : exact) {
      const Mat3 dX_dxi = mesh::jacobian(
          mesh_, {c, cell, point.phi, {point.gradient.front().data(), 3 * cell.size()}});
      const double volume = point.weight * dX_dxi.determinant();
      for (std::size_t a = 0; a < cell.size(); ++a)
        for (std::size_t b = 0; b < cell.size(); ++b)
          entries.emplace_back(cell[a], cell[b], volume * point.phi[a] * point.phi[b]);
    }
  }
  mass_.setFromTriplets(entries.begin(), entries.end());
}

std::array<int, 3> QuadratureCoupling::points_along(std::span<const int> cell,
                                                    std::span<const Vec3> positions) const {
  const auto needed = [&](double length) {
    constexpr int fewest = 2;  // phi det has degree three: fewer points would lose force
    return std::max(fewest, static_cast<int>(std::ceil(points_per_cell_ * length / spacing_)));
  };
  const auto for_longest = [&](std::span<const std::array<int, 2>> edges) {
    double longest = 0.0;
    for (const auto& [a, b] : edges)
      longest = std::max(longest, (positions[cell[b]] - positions[cell[a]]).norm());
    return needed(longest);
  };
  const auto edges = mesh::cell_edges(mesh_.kind);
  if (mesh_.kind == mesh::CellKind::tetrahedron) {
    const int n = for_longest(edges);
    return {n, n, n};
  }
  return {for_longest(edges.subspan(0, 4)), for_longest(edges.subspan(4, 4)),
          for_longest(edges.subspan(8, 4))};
}

const QuadratureCoupling::Rule& QuadratureCoupling::rule(const std::array<int, 3>& points) const {
  const auto found = rules_.find(points);
  return found != rules_.end() ? found->second
                               : rules_.emplace(points, make_rule(points)).first->second;
}

/// Products of Gauss rules; on tetrahedra collapsed onto the simplex, (r, s(1-r), t(1-r)(1-s)).
QuadratureCoupling::Rule QuadratureCoupling::make_rule(const std::array<int, 3>& points) const {
  Rule rule;
  for (const auto& [r, wr] : mesh::gauss(points[0]))
    for (const auto& [s, ws] : mesh::gauss(points[1]))
      for (const auto& [t, wt] : mesh::gauss(points[2])) {
        ReferencePoint point{};
        if (mesh_.kind == mesh::CellKind::hexahedron) {
          point.weight = wr * ws * wt;
          set_shapes(point, solid::Hex8::shapes({r, s, t}));
        } else {
          point.weight = wr * ws * wt * (1 - r) * (1 - r) * (1 - s);
          set_shapes(point, solid::Tet4::shapes({r, s * (1 - r), t * (1 - r) * (1 - s)}));
        }
        rule.push_back(point);
      }
  return rule;
}

/// Calls visit(cell's nodes, phi, w, x) for every quadrature point of elements that reach this
/// slab.
template <class Visit>
void QuadratureCoupling::for_points(std::span<const Vec3> positions, const Visit& visit) const {
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    const auto cell = mesh_.cell(c);
    double z_min = positions[cell[0]].z();
    double z_max = z_min;
    for (const int a : cell) {
      z_min = std::min(z_min, positions[a].z());
      z_max = std::max(z_max, positions[a].z());
    }
    if (!transfer_.reaches(z_min, z_max))
      continue;
    for (const ReferencePoint& point : rule(points_along(cell, positions))) {
      Mat3 dX_dxi = Mat3::Zero();
      Vec3 x = Vec3::Zero();
      for (std::size_t a = 0; a < cell.size(); ++a) {
        dX_dxi += mesh_.nodes[cell[a]] * Vec3(point.gradient[a].data()).transpose();
        x += point.phi[a] * positions[cell[a]];
      }
      visit(cell, point.phi, point.weight * dX_dxi.determinant(), x);
    }
  }
}

/// Solves M U = loads, one component at a time.
std::vector<Vec3> QuadratureCoupling::project(std::span<const Vec3> loads) const {
  std::vector<Vec3> values(loads.size());
  Eigen::VectorXd right(static_cast<Eigen::Index>(loads.size()));
  for (int d = 0; d < 3; ++d) {
    for (std::size_t a = 0; a < loads.size(); ++a)
      right[static_cast<Eigen::Index>(a)] = loads[a][d];
    const Eigen::VectorXd solution = solver_.solve(right);
    for (std::size_t a = 0; a < loads.size(); ++a)
      values[a][d] = solution[static_cast<Eigen::Index>(a)];
  }
  return values;
}

void QuadratureCoupling::spread(std::span<const Vec3> positions, std::span<const Vec3> forces,
                                fluid::FaceField& force) const {
  const std::vector<Vec3> density = project(forces);
  for_points(positions, [&](std::span<const int> cell, const std::array<double, 8>& phi, double w,
                            const Vec3& x) {
    Vec3 F = Vec3::Zero();
    for (std::size_t a = 0; a < cell.size(); ++a)
      F += phi[a] * density[cell[a]];
    transfer_.spread(x, w * F, force);
  });
}

void QuadratureCoupling::interpolate(const fluid::FaceField& velocity,
                                     std::span<const Vec3> positions,
                                     std::span<Vec3> velocities) const {
  std::fill(velocities.begin(), velocities.end(), Vec3::Zero());
  for_points(positions, [&](std::span<const int> cell, const std::array<double, 8>& phi, double w,
                            const Vec3& x) {
    if (!transfer_.owns(x))
      return;
    const Vec3 U = w * transfer_.interpolate(velocity, x);
    for (std::size_t a = 0; a < cell.size(); ++a)
      velocities[cell[a]] += phi[a] * U;
  });
  parallel::sum({velocities.data()->data(), 3 * velocities.size()});
  const std::vector<Vec3> projected = project(velocities);
  std::copy(projected.begin(), projected.end(), velocities.begin());
}

std::size_t QuadratureCoupling::point_count(std::span<const Vec3> positions) const {
  std::size_t count = 0;
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    const auto points = points_along(mesh_.cell(c), positions);
    count += static_cast<std::size_t>(points[0]) * points[1] * points[2];
  }
  return count;
}

}  // namespace lv::immersed
