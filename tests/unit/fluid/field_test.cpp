#include "lv/fluid/field.hpp"

#include "support/fluid_fields.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using fluid::Component;
using fluid::FaceField;
using fluid::Grid;

const Grid field_grid{{5, 7, 6}, {0, 0, 0}, {1.5, 2.0, 1.0}};

}  // namespace

TEST_CASE("a field gathered and scattered is itself", "[unit][fluid]") {
  FaceField field = test::random_field(field_grid, 1);
  for (Component& u : field.component) {
    const auto values = fluid::gather(u);
    REQUIRE(values.size() == static_cast<std::size_t>(u.nx()) * u.ny() * u.nz());
    CHECK(values[0] == u.at(0, 0, 0));
    CHECK(values[1] == u.at(1, 0, 0));  // x fastest, z slowest
    CHECK(values[u.nx()] == u.at(0, 1, 0));
    CHECK(values[u.nx() * u.ny()] == u.at(0, 0, 1));
    CHECK(values.back() == u.at(u.nx() - 1, u.ny() - 1, u.nz() - 1));
    Component other(u.nx(), u.ny(), u.nz());
    fluid::scatter(values, other);
    CHECK(other.values() == u.values());
  }
}

TEST_CASE("rows and ghosts of a component do not overlap", "[unit][fluid]") {
  Component u(5, 7, 6);
  double next = 0.0;
  test::for_points(u, fluid::ghost_layers, [&](int, int, int, double& value) { value = ++next; });
  double expected = 0.0;
  test::for_points(u, fluid::ghost_layers,
                   [&](int, int, int, double& value) { CHECK(value == ++expected); });
}

TEST_CASE("at the box's sides ghosts mirror the normal velocity and reverse the tangential",
          "[unit][fluid]") {
  FaceField field = test::random_field(field_grid, 2);
  fluid::fill_ghosts(field, test::whole_box(field_grid));
  for (int c = 0; c < 3; ++c) {
    Component& u = field.component[c];
    const std::array<int, 3> n{u.nx(), u.ny(), u.nz()};
    test::for_points(u, fluid::ghost_layers, [&](int i, int j, int k, double& value) {
      std::array<int, 3> image{i, j, k};
      double sign = 1.0;
      for (int d = 0; d < 3; ++d) {
        if (image[d] >= 0 && image[d] < n[d])
          continue;
        // faces lie on the side itself, cell centres half a cell inside
        const int sum_of_pair =
            image[d] < 0 ? (d == c ? 0 : -1) : (d == c ? 2 * n[d] - 2 : 2 * n[d] - 1);
        image[d] = sum_of_pair - image[d];
        sign *= d == c ? 1.0 : -1.0;
      }
      CHECK(value == sign * u.at(image[0], image[1], image[2]));
    });
  }
}

TEST_CASE("ghosts of the pressure make it vanish on the box's sides", "[unit][fluid]") {
  test::RandomValues random(3);
  Component p(5, 7, 6);
  test::for_points(p, 0, [&](int, int, int, double& value) { value = random(); });
  fluid::fill_ghosts(p, test::whole_box(field_grid));
  for (int l = 0; l < fluid::ghost_layers; ++l) {
    CHECK(p.at(-1 - l, 3, 2) == -p.at(l, 3, 2));
    CHECK(p.at(5 + l, 3, 2) == -p.at(4 - l, 3, 2));
    CHECK(p.at(1, -1 - l, 2) == -p.at(1, l, 2));
    CHECK(p.at(1, 7 + l, 2) == -p.at(1, 6 - l, 2));
    CHECK(p.at(1, 3, -1 - l) == -p.at(1, 3, l));
    CHECK(p.at(1, 3, 6 + l) == -p.at(1, 3, 5 - l));
  }
}

TEST_CASE("the motion of a field is its kinetic energy and largest velocity", "[unit][fluid]") {
  FaceField field = test::random_field(field_grid, 4);
  field.component[1].at(2, 3, 4) = -7.5;
  field.component[1].at(-1, 3, 4) = 100.0;  // a ghost does not count
  const auto motion = fluid::motion(field, field_grid, 1.06e-6);
  CHECK(motion.largest_velocity == 7.5);
  CHECK(motion.kinetic_energy ==
        Approx(0.5 * 1.06e-6 * 3.0 * test::product(field, field)).epsilon(1e-13));
  field.set_zero();
  CHECK(fluid::motion(field, field_grid, 1.0).kinetic_energy == 0.0);
}
