#include "lv/mesh/shapes.hpp"

#include "support/cell_kinds.hpp"
#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using mesh::CellKind;
using mesh::Shapes;
using test::kinds;

template <int Dim>
std::array<double, Dim> some_place(test::RandomValues& random) {
  std::array<double, Dim> xi;
  for (double& x : xi)
    x = 0.5 + 0.4 * random();
  return xi;
}

template <int Dim>
void check_gradients(CellKind kind, int order) {
  test::RandomValues random(1);
  constexpr double h = 1e-3;  // the polynomials are of degree six at most
  const auto xi = some_place<Dim>(random);
  const Shapes at = mesh::shapes<Dim>(kind, order, xi);
  CHECK(at.value.sum() == Approx(1.0));
  for (int d = 0; d < Dim; ++d) {
    auto ahead = xi, behind = xi;
    ahead[d] += h;
    behind[d] -= h;
    const Eigen::VectorXd slope = (mesh::shapes<Dim>(kind, order, ahead).value -
                                   mesh::shapes<Dim>(kind, order, behind).value) /
                                  (2.0 * h);
    CHECK((slope - at.gradient.row(d).transpose()).norm() < 1e-9);  // quadratic in each direction
  }
}

}  // namespace

TEST_CASE("a shape function is 1 at its own node and 0 at the others", "[unit][mesh]") {
  for (const CellKind kind : kinds) {
    for (const int order : {1, 2}) {
      const std::vector<Vec3> places = mesh::node_places(kind, order);
      for (std::size_t a = 0; a < places.size(); ++a) {
        const Vec3& xi = places[a];
        const Shapes at = mesh::shapes<3>(kind, order, {xi.x(), xi.y(), xi.z()});
        REQUIRE(at.value.size() == static_cast<Eigen::Index>(places.size()));
        Eigen::VectorXd expected = Eigen::VectorXd::Zero(at.value.size());
        expected[static_cast<Eigen::Index>(a)] = 1.0;
        CHECK((at.value - expected).norm() == 0.0);
      }
    }
  }
}

TEST_CASE("gradients of shape functions are their derivatives", "[unit][mesh]") {
  for (const CellKind kind : kinds) {
    for (const int order : {1, 2}) {
      check_gradients<2>(kind, order);
      check_gradients<3>(kind, order);
    }
  }
}

TEST_CASE("corners of a cell go round as VTK has them", "[unit][mesh]") {
  const std::array<Vec3, 8> corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0),
                                    Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(0, 1, 1)};
  for (int a = 0; a < 8; ++a) {
    const Vec3& xi = corners[a];
    CHECK(mesh::hexahedron_shapes({xi.x(), xi.y(), xi.z()}).value[a] == 1.0);
    for (int d = 0; d < 3; ++d)
      CHECK(mesh::corner_place(a, d) == xi[d]);
  }
}
