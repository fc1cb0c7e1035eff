#include "lv/solid/shape_table.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/shapes.hpp"
#include "lv/solid/quadrature.hpp"

#include <cmath>

namespace lv::solid {
namespace {

using mesh::CellKind;

template <int Dim>
using Place = std::array<double, Dim>;

/// Calls visit(place, weight) for the points of the displacement's own rule.
template <int Dim, class Visit>
void for_points(CellKind kind, int order, const Visit& visit) {
  for (const QuadraturePoint<Dim>& point : quadrature<Dim>(kind, order))
    visit(point.xi, point.weight);
}

/// The table of functions that `at` gives at each of the points.
template <class Points, class At>
ShapeTable tabulate(const Points& points, const At& at) {
  std::vector<double> weights;
  std::vector<Eigen::VectorXd> values;
  ShapeTable table;
  points([&](const auto& xi, double weight) {
    mesh::Shapes shapes = at(xi);
    weights.push_back(weight);
    values.push_back(std::move(shapes.value));
    table.gradient.push_back(std::move(shapes.gradient));
  });
  const auto count = static_cast<Eigen::Index>(weights.size());
  table.weight = Eigen::Map<const Eigen::VectorXd>(weights.data(), count);
  table.value.resize(count, values.front().size());
  for (Eigen::Index q = 0; q < count; ++q)
    table.value.row(q) = values[q];
  return table;
}

auto own_points(CellKind kind, int order) {
  return [=](const auto& visit) { for_points<3>(kind, order, visit); };
}

auto points_of(const ReferencePoints& at) {
  return [&](const auto& visit) {
    for (std::size_t q = 0; q < at.places.size(); ++q)
      visit(Place<3>{at.places[q].x(), at.places[q].y(), at.places[q].z()}, at.weights[q]);
  };
}

template <int Dim>
auto displacement(CellKind kind, int order) {
  return [=](const Place<Dim>& xi) { return mesh::shapes<Dim>(kind, order, xi); };
}

/// Legendre polynomials of a hexahedron, scaled to be orthonormal; the corners' functions of a
/// tetrahedron.
mesh::Shapes pressure_at(CellKind kind, int order, const Place<3>& xi) {
  if (kind == CellKind::tetrahedron) {
    LV_CHECK(order == 2);
    return mesh::shapes<3>(kind, 1, xi);
  }
  if (order == 1)
    return {Eigen::VectorXd::Ones(1), {}};
  const double root = std::sqrt(3.0);
  return {Eigen::Vector4d(1.0, root * (2.0 * xi[0] - 1.0), root * (2.0 * xi[1] - 1.0),
                          root * (2.0 * xi[2] - 1.0)),
          {}};
}

auto pressure(CellKind kind, int order) {
  return [=](const Place<3>& xi) { return pressure_at(kind, order, xi); };
}

}  // namespace

ShapeTable element_shapes(CellKind kind, int order) {
  return tabulate(own_points(kind, order), displacement<3>(kind, order));
}

ShapeTable side_shapes(CellKind kind, int order) {
  return tabulate([=](const auto& visit) { for_points<2>(kind, order, visit); },
                  displacement<2>(kind, order));
}

ShapeTable pressure_shapes(CellKind kind, int order) {
  return tabulate(own_points(kind, order), pressure(kind, order));
}

ShapeTable element_shapes(CellKind kind, int order, const ReferencePoints& points) {
  return tabulate(points_of(points), displacement<3>(kind, order));
}

ShapeTable pressure_shapes(CellKind kind, int order, const ReferencePoints& points) {
  return tabulate(points_of(points), pressure(kind, order));
}

}  // namespace lv::solid
