#include "lv/solid/shape_table.hpp"

#include "lv/base/check.hpp"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgp.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <cmath>
#include <numeric>

namespace lv::solid {
namespace {

using mesh::CellKind;

template <int dim>
dealii::Quadrature<dim> quadrature(CellKind kind, int order) {
  if (kind == CellKind::hexahedron)
    return dealii::QGauss<dim>(order + 1);
  return dealii::QGaussSimplex<dim>(order + 1);
}

/// For each of our nodes, the number of deal.II's shape function: its lattices begin with the
/// corners, ours run along rows.
template <int dim>
std::vector<unsigned> numbering(const dealii::FiniteElement<dim>& fe, CellKind kind, int order) {
  std::vector<unsigned> numbers(fe.dofs_per_cell);
  std::iota(numbers.begin(), numbers.end(), 0U);
  if (kind == CellKind::tetrahedron)
    return numbers;
  const auto& points = fe.get_unit_support_points();
  for (unsigned a = 0; a < points.size(); ++a) {
    long place = 0;
    for (int d = dim - 1; d >= 0; --d)
      place = place * (order + 1) + std::lround(points[a][d] * order);
    numbers.at(place) = a;
  }
  return numbers;
}

template <int dim>
ShapeTable tabulate(const dealii::FiniteElement<dim>& fe, const std::vector<unsigned>& numbers,
                    const dealii::Quadrature<dim>& rule) {
  ShapeTable table;
  const auto points = static_cast<Eigen::Index>(rule.size());
  const auto nodes = static_cast<Eigen::Index>(numbers.size());
  table.weight.resize(points);
  table.value.resize(points, nodes);
  for (Eigen::Index q = 0; q < points; ++q) {
    table.weight[q] = rule.weight(q);
    Eigen::MatrixXd gradient(dim, nodes);
    for (Eigen::Index a = 0; a < nodes; ++a) {
      table.value(q, a) = fe.shape_value(numbers[a], rule.point(q));
      const auto derivative = fe.shape_grad(numbers[a], rule.point(q));
      for (int d = 0; d < dim; ++d)
        gradient(d, a) = derivative[d];
    }
    table.gradient.push_back(gradient);
  }
  return table;
}

dealii::Quadrature<3> quadrature(const ReferencePoints& at) {
  std::vector<dealii::Point<3>> points;
  for (const Vec3& xi : at.places)
    points.emplace_back(xi.x(), xi.y(), xi.z());
  return {points, at.weights};
}

/// Calls f with the finite element of the displacement.
template <int dim, class F>
auto with_displacement(CellKind kind, int order, const F& f) {
  LV_CHECK(order == 1 || order == 2);
  if (kind == CellKind::hexahedron)
    return f(dealii::FE_Q<dim>(order));
  return f(dealii::FE_SimplexP<dim>(order));
}

template <int dim>
ShapeTable displacement(CellKind kind, int order, const dealii::Quadrature<dim>& rule) {
  return with_displacement<dim>(kind, order, [&](const auto& fe) {
    return tabulate<dim>(fe, numbering<dim>(fe, kind, order), rule);
  });
}

ShapeTable pressure(CellKind kind, int order, const dealii::Quadrature<3>& rule) {
  const auto make = [&](const dealii::FiniteElement<3>& fe) {
    std::vector<unsigned> all(fe.dofs_per_cell);
    std::iota(all.begin(), all.end(), 0U);
    return tabulate(fe, all, rule);
  };
  if (kind == CellKind::hexahedron)
    return make(dealii::FE_DGP<3>(order - 1));
  LV_CHECK(order == 2);
  return make(dealii::FE_SimplexP<3>(1));
}

}  // namespace

ShapeTable element_shapes(CellKind kind, int order) {
  return displacement<3>(kind, order, quadrature<3>(kind, order));
}

ShapeTable side_shapes(CellKind kind, int order) {
  return displacement<2>(kind, order, quadrature<2>(kind, order));
}

ShapeTable pressure_shapes(CellKind kind, int order) {
  return pressure(kind, order, quadrature<3>(kind, order));
}

ShapeTable element_shapes(CellKind kind, int order, const ReferencePoints& points) {
  return displacement<3>(kind, order, quadrature(points));
}

ShapeTable pressure_shapes(CellKind kind, int order, const ReferencePoints& points) {
  return pressure(kind, order, quadrature(points));
}

std::vector<Vec3> node_places(CellKind kind, int order) {
  return with_displacement<3>(kind, order, [&](const auto& fe) {
    std::vector<Vec3> places;
    for (const unsigned number : numbering<3>(fe, kind, order)) {
      const auto& p = fe.get_unit_support_points()[number];
      places.emplace_back(p[0], p[1], p[2]);
    }
    return places;
  });
}

}  // namespace lv::solid
