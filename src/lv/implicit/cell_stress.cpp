#include "lv/base/check.hpp"
#include "lv/base/parallel.hpp"
#include "lv/implicit/constitution.hpp"
#include "lv/implicit/equations.hpp"
#include "lv/solid/element.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <map>
#include <numeric>

/// Stress of the mesh's linear cells from the quadratic elements that they are parts of.
namespace lv::implicit {
namespace {

using mesh::CellKind;
using solid::CellStress;

/// The quadrature points of a linear cell whose corners lie at these places of a reference element.
template <class E>
solid::ReferencePoints points_of_part(const std::vector<Vec3>& corners) {
  constexpr auto rule = E::full_quadrature();
  solid::ReferencePoints points;
  for (int q = 0; q < E::points; ++q) {
    Vec3 place = Vec3::Zero();
    Mat3 jacobian = Mat3::Zero();
    for (int a = 0; a < E::nodes; ++a) {
      place += rule.value[q][a] * corners[a];
      jacobian += corners[a] * Vec3(rule.gradient[q][a].data()).transpose();
    }
    points.places.push_back(place);
    points.weights.push_back(rule.weight[q] * std::abs(jacobian.determinant()));
  }
  return points;
}

/// Shapes of displacement and pressure at the quadrature points of a part, and for each of these
/// the nearest quadrature point of the element.
struct PartShapes {
  solid::ShapeTable displacement, pressure;
  std::vector<std::size_t> nearest;
};

/// The tables of parts, made once for each way in which a part lies in its element.
class PartTables {
 public:
  explicit PartTables(const mesh::Mesh& mesh)
      : mesh_(mesh), places_(mesh::node_places(mesh.kind, mesh.order)) {
    const Eigen::MatrixXd phi = solid::element_shapes(mesh.kind, mesh.order).value;
    for (Eigen::Index q = 0; q < phi.rows(); ++q) {
      Vec3 place = Vec3::Zero();
      for (Eigen::Index a = 0; a < phi.cols(); ++a)
        place += phi(q, a) * places_[static_cast<std::size_t>(a)];
      own_points_.push_back(place);
    }
  }

  const PartShapes& of(int cell, std::span<const int> element) {
    std::vector<int> where;
    for (const int node : mesh_.cell(cell))
      where.push_back(
          static_cast<int>(std::find(element.begin(), element.end(), node) - element.begin()));
    const auto [entry, added] = tables_.try_emplace(where);
    if (added)
      entry->second = make(where);
    return entry->second;
  }

 private:
  [[nodiscard]] PartShapes make(const std::vector<int>& where) const {
    std::vector<Vec3> corners;
    for (const int a : where)
      corners.push_back(places_.at(a));
    const auto points = mesh_.kind == CellKind::hexahedron ? points_of_part<solid::Hex8>(corners)
                                                           : points_of_part<solid::Tet4>(corners);
    return {solid::element_shapes(mesh_.kind, mesh_.order, points),
            solid::pressure_shapes(mesh_.kind, mesh_.order, points), nearest(points.places)};
  }

  [[nodiscard]] std::vector<std::size_t> nearest(const std::vector<Vec3>& places) const {
    std::vector<std::size_t> result;
    for (const Vec3& place : places)
      result.push_back(std::min_element(own_points_.begin(), own_points_.end(),
                                        [&](const Vec3& a, const Vec3& b) {
                                          return (a - place).norm() < (b - place).norm();
                                        }) -
                       own_points_.begin());
    return result;
  }

  const mesh::Mesh& mesh_;
  std::vector<Vec3> places_;
  std::vector<Vec3> own_points_;  ///< the element's quadrature points
  std::map<std::vector<int>, PartShapes> tables_;
};

}  // namespace

std::vector<CellStress> Equations::cell_stress(const State& state, const TensionAt& tension) const {
  const PointMaker maker(mesh_);
  PartTables tables(mesh_);
  const int parts = mesh::cells_per_element(mesh_.order);
  std::vector<CellStress> result(mesh_.cell_count());
  for (std::size_t i = 0; i < wall_.points.size(); ++i) {
    const int e = wall_.own[i];
    const auto nodes = wall_.elements.element(e);
    const ElementState s = element_state(wall_, e, state);
    for (int cell = parts * e; cell < parts * (e + 1); ++cell) {
      const PartShapes& shapes = tables.of(cell, nodes);
      const auto points = maker.points(shapes.displacement, parts * e, nodes);
      const double volume =
          std::accumulate(points.begin(), points.end(), 0.0,
                          [](double sum, const Point& point) { return sum + point.volume; });
      for (std::size_t q = 0; q < points.size(); ++q) {
        const Mat3 F = s.x * points[q].gradient.transpose();
        const Constitution law{model_, tension, i, shapes.nearest[q]};
        CellStress here = law.cauchy(F, points[q].infarct);
        here.pressure -= shapes.pressure.value.row(static_cast<Eigen::Index>(q)).dot(s.p);
        result[cell].add(points[q].volume / volume, here);
      }
    }
  }
  parallel::sum({&result.front().tension, CellStress::numbers * result.size()});
  return result;
}

}  // namespace lv::implicit
