#include "lv/solid/quadrature.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using mesh::CellKind;

/// int of x^i y^j z^k over the reference element by the rule.
template <int Dim>
double integral(CellKind kind, int order, const std::array<int, 3>& power) {
  double sum = 0.0;
  for (const solid::QuadraturePoint<Dim>& point : solid::quadrature<Dim>(kind, order)) {
    double term = point.weight;
    for (int d = 0; d < Dim; ++d)
      term *= std::pow(point.xi[d], power[d]);
    sum += term;
  }
  return sum;
}

double factorial(int n) {
  return std::tgamma(n + 1.0);
}

/// The same exactly: i! j! k!/(i + j + k + Dim)! on simplices, 1/((i + 1)(j + 1)(k + 1)) on cubes.
double exact(CellKind kind, int dimension, const std::array<int, 3>& power) {
  const auto [i, j, k] = power;
  if (kind == CellKind::tetrahedron)
    return factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + dimension);
  return 1.0 / ((i + 1) * (j + 1) * (k + 1));
}

template <int Dim>
void check_degree(CellKind kind, int order, int degree) {
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= (Dim == 3 ? degree : i + j); ++k) {
        INFO("powers " << i << ' ' << j << ' ' << k << ", dimension " << Dim << ", order "
                       << order);
        CHECK(integral<Dim>(kind, order, {i, j, k}) ==
              Approx(exact(kind, Dim, {i, j, k})).epsilon(1e-13));
      }
}

}  // namespace

TEST_CASE("quadrature integrates polynomials of its degree exactly", "[unit][solid]") {
  for (const int order : {1, 2}) {
    check_degree<2>(CellKind::hexahedron, order, 2 * order + 1);
    check_degree<3>(CellKind::hexahedron, order, 2 * order + 1);
    check_degree<2>(CellKind::tetrahedron, order, 2 * order + 1);
    check_degree<3>(CellKind::tetrahedron, order, 2 * order + 1);
  }
}

TEST_CASE("quadrature of a square and a cube takes every power of its degree in each direction",
          "[unit][solid]") {
  CHECK(integral<2>(CellKind::hexahedron, 2, {5, 5, 0}) == Approx(1.0 / 36.0).epsilon(1e-13));
  CHECK(integral<3>(CellKind::hexahedron, 1, {3, 3, 3}) == Approx(1.0 / 64.0).epsilon(1e-13));
}
