#include "lv/solid/shape_table.hpp"

#include "support/cell_kinds.hpp"
#include <catch2/catch.hpp>

using namespace lv;
using mesh::CellKind;

TEST_CASE("shapes sum to one at every point, and weights to the reference element's size",
          "[unit][solid]") {
  for (const CellKind kind : test::kinds)
    for (const int order : {1, 2}) {
      const auto element = solid::element_shapes(kind, order);
      const auto side = solid::side_shapes(kind, order);
      const bool is_cube = kind == CellKind::hexahedron;
      CHECK(element.weight.sum() == Approx(is_cube ? 1.0 : 1.0 / 6.0).epsilon(1e-13));
      CHECK(side.weight.sum() == Approx(is_cube ? 1.0 : 0.5).epsilon(1e-13));
      for (const auto& table : {element, side})
        for (int q = 0; q < table.points(); ++q) {
          CHECK(table.value.row(q).sum() == Approx(1.0).epsilon(1e-13));
          CHECK(table.gradient[q].rowwise().sum().norm() < 1e-13);
        }
    }
}

TEST_CASE("the pressures of hexahedra are orthonormal", "[unit][solid]") {
  for (const int order : {1, 2}) {
    const auto N = solid::pressure_shapes(CellKind::hexahedron, order);
    const Eigen::MatrixXd products = N.value.transpose() * N.weight.asDiagonal() * N.value;
    CHECK(N.nodes() == (order == 1 ? 1 : 4));
    CHECK((products - Eigen::MatrixXd::Identity(N.nodes(), N.nodes())).norm() < 1e-13);
  }
}

TEST_CASE("tables at other points have those points' shapes", "[unit][solid]") {
  for (const CellKind kind : test::kinds) {
    const Vec3 at(0.2, 0.3, 0.1);
    const auto shapes = solid::element_shapes(kind, 1, {{at}, {0.7}});
    CHECK(shapes.weight[0] == 0.7);
    CHECK(shapes.value(0, 0) ==
          Approx(kind == CellKind::hexahedron ? 0.8 * 0.7 * 0.9 : 0.4).epsilon(1e-14));
  }
}
