#include "lv/solid/interpolate.hpp"

#include "lv/base/check.hpp"
#include "lv/base/dense.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/shapes.hpp"

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace lv::solid {
namespace {

using mesh::CellKind;

constexpr unsigned candidates = 16;  // elements with the nearest centres
constexpr int corrections = 30;
constexpr double converged = 1e-10;  // of xi
constexpr double farthest = 0.25;    // outside an element, in units of xi

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

  [[nodiscard]] mesh::Shapes shapes(const Vec3& xi) const {
    return mesh::shapes<3>(mesh_.kind, mesh_.order, {xi.x(), xi.y(), xi.z()});
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
      const mesh::Shapes s = shapes(xi);
      const Mat3 dX = X * s.gradient.transpose();
      const Vec3 step = dense::solve(dX, x - X * s.value);
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
