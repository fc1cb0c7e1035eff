#include "lv/solid/interpolate.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/quadratic.hpp"

#include <Eigen/LU>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace lv::solid {
namespace {

using mesh::CellKind;

constexpr unsigned candidates = 16;  // elements with the nearest centres
constexpr int corrections = 30;
constexpr double converged = 1e-10;  // of xi
constexpr double farthest = 0.25;    // outside an element, in units of xi

/// phi_a(xi) and d phi_a/d xi, in the order of mesh::elements.
struct Shapes {
  Eigen::VectorXd value;
  Eigen::Matrix3Xd gradient;
};

/// The Lagrange polynomials on the nodes 0, (1/2), 1 and their derivatives.
struct Line {
  std::array<double, 3> value{}, slope{};
};

Line line(double x, int order) {
  if (order == 1)
    return {{1.0 - x, x, 0.0}, {-1.0, 1.0, 0.0}};
  return {{(1.0 - x) * (1.0 - 2.0 * x), 4.0 * x * (1.0 - x), x * (2.0 * x - 1.0)},
          {4.0 * x - 3.0, 4.0 - 8.0 * x, 4.0 * x - 1.0}};
}

Shapes hexahedron(const Vec3& xi, int order) {
  const int n = order + 1;
  const std::array<Line, 3> l{line(xi[0], order), line(xi[1], order), line(xi[2], order)};
  Shapes s{Eigen::VectorXd(n * n * n), Eigen::Matrix3Xd(3, n * n * n)};
  int a = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i, ++a) {
        s.value[a] = l[0].value[i] * l[1].value[j] * l[2].value[k];
        s.gradient.col(a) << l[0].slope[i] * l[1].value[j] * l[2].value[k],
            l[0].value[i] * l[1].slope[j] * l[2].value[k],
            l[0].value[i] * l[1].value[j] * l[2].slope[k];
      }
  return s;
}

Shapes tetrahedron(const Vec3& xi, int order) {
  const std::array<double, 4> L{1.0 - xi.sum(), xi[0], xi[1], xi[2]};
  const std::array<Vec3, 4> dL{-Vec3::Ones(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  constexpr std::array<std::array<int, 2>, 6> edges{
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  const int n = order == 1 ? 4 : 10;
  Shapes s{Eigen::VectorXd(n), Eigen::Matrix3Xd(3, n)};
  for (int a = 0; a < 4; ++a) {
    s.value[a] = order == 1 ? L[a] : L[a] * (2.0 * L[a] - 1.0);
    s.gradient.col(a) = order == 1 ? dL[a] : Vec3((4.0 * L[a] - 1.0) * dL[a]);
  }
  for (int e = 0; order == 2 && e < 6; ++e) {
    const auto [a, b] = edges[e];
    s.value[4 + e] = 4.0 * L[a] * L[b];
    s.gradient.col(4 + e) = 4.0 * (L[a] * dL[b] + L[b] * dL[a]);
  }
  return s;
}

/// How far xi lies outside the reference element; at most zero inside.
double outside(const Vec3& xi, CellKind kind) {
  const double below = -xi.minCoeff();
  return std::max(below, kind == CellKind::hexahedron ? xi.maxCoeff() - 1.0 : xi.sum() - 1.0);
}

class Interpolation {
 public:
  explicit Interpolation(const mesh::Mesh& mesh)
      : mesh_(mesh), elements_(mesh::elements(mesh)), centres_(tree(mesh, elements_)) {}

  [[nodiscard]] Vec3 at(const Vec3& x, std::span<const Vec3> values) const {
    std::vector<Entry> near;
    centres_.query(boost::geometry::index::nearest(Point(x.x(), x.y(), x.z()), candidates),
                   std::back_inserter(near));
    double least = std::numeric_limits<double>::infinity();
    int best = -1;
    Vec3 best_xi = Vec3::Zero();
    for (const Entry& entry : near) {
      const auto xi = local(entry.second, x);
      if (xi && outside(*xi, mesh_.kind) < least) {
        least = outside(*xi, mesh_.kind);
        best = entry.second;
        best_xi = *xi;
      }
    }
    if (least > farthest)
      throw RunError(
          fmt::format("The point ({:.1f}, {:.1f}, {:.1f}) mm lies outside the mesh that "
                      "a field is taken from",
                      x.x(), x.y(), x.z()),
          "Both meshes must be of the same wall; take a smaller quasi_static.edge_length");
    return gather(best, values) * shapes(best_xi).value;
  }

 private:
  using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Entry = std::pair<Point, int>;
  using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>>;

  static Tree tree(const mesh::Mesh& mesh, const mesh::ElementNodes& elements) {
    std::vector<Entry> entries;
    for (int e = 0; e < elements.size(); ++e) {
      Vec3 centre = Vec3::Zero();
      for (const int node : elements.element(e))
        centre += mesh.nodes[node] / static_cast<double>(elements.nodes_per_element);
      entries.emplace_back(Point(centre.x(), centre.y(), centre.z()), e);
    }
    return Tree(entries);
  }

  [[nodiscard]] Shapes shapes(const Vec3& xi) const {
    return mesh_.kind == CellKind::hexahedron ? hexahedron(xi, mesh_.order)
                                              : tetrahedron(xi, mesh_.order);
  }

  [[nodiscard]] Eigen::Matrix3Xd gather(int e, std::span<const Vec3> values) const {
    Eigen::Matrix3Xd result(3, elements_.nodes_per_element);
    for (int a = 0; a < elements_.nodes_per_element; ++a)
      result.col(a) = values[elements_.element(e)[a]];
    return result;
  }

  /// xi of a point in an element, by Newton's method; nothing where that does not end.
  [[nodiscard]] std::optional<Vec3> local(int e, const Vec3& x) const {
    const Eigen::Matrix3Xd X = gather(e, mesh_.nodes);
    Vec3 xi = Vec3::Constant(mesh_.kind == CellKind::hexahedron ? 0.5 : 0.25);
    for (int i = 0; i < corrections; ++i) {
      const Shapes s = shapes(xi);
      const Mat3 dX = X * s.gradient.transpose();
      const Vec3 step = dX.partialPivLu().solve(x - X * s.value);
      if (!step.allFinite())
        return {};
      const double length = step.norm();
      xi += length > 0.5 ? Vec3(step * (0.5 / length)) : step;
      if (length < converged)
        return xi;
    }
    return {};
  }

  const mesh::Mesh& mesh_;
  mesh::ElementNodes elements_;
  Tree centres_;
};

}  // namespace

std::vector<Vec3> interpolate(const mesh::Mesh& mesh, std::span<const Vec3> values,
                              std::span<const Vec3> points) {
  const Interpolation interpolation(mesh);
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (const Vec3& x : points)
    result.push_back(interpolation.at(x, values));
  return result;
}

}  // namespace lv::solid
