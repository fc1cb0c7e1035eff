#include "lv/fluid/advect.hpp"

#include "support/fluid_fields.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using fluid::FaceField;
using fluid::Grid;

Grid cube(int n) {
  return {{n, n, n}, {0, 0, 0}, Vec3::Constant(2.0 * M_PI / n)};
}

/// N(u), by asking for the force of unit density.
FaceField convection(const FaceField& velocity, const Grid& grid) {
  FaceField previous(grid, test::whole_box(grid));
  FaceField force(grid, test::whole_box(grid));
  fluid::convection_force(velocity, grid, 1.0, {-1.0, 0.0}, previous, force);
  return force;
}

double largest(FaceField& field) {
  double value = 0.0;
  for (fluid::Component& u : field.component)
    test::for_points(u, 0, [&](int, int, int, double& x) { value = std::max(value, std::abs(x)); });
  return value;
}

/// A steady flow without divergence, and u.grad u.
double vortex(int c, const Vec3& x) {
  const double s = std::sin(x.x()) * std::cos(x.y());
  const double t = -std::cos(x.x()) * std::sin(x.y());
  return c == 0 ? 0.7 + s : c == 1 ? -0.4 + t : 0.5 * std::sin(x.x() + x.y());
}
double vortex_convection(int c, const Vec3& x) {
  const double u = vortex(0, x);
  const double v = vortex(1, x);
  const double cc = std::cos(x.x()) * std::cos(x.y());
  const double ss = std::sin(x.x()) * std::sin(x.y());
  if (c == 0)
    return u * cc - v * ss;
  if (c == 1)
    return u * ss - v * cc;
  return (u + v) * 0.5 * std::cos(x.x() + x.y());
}

double error_of_vortex(int n) {
  const Grid grid = cube(n);
  FaceField error = convection(test::field_of(grid, vortex), grid);
  for (int c = 0; c < 3; ++c)
    test::for_points(error.component[c], 0, [&](int i, int j, int k, double& N) {
      N -= vortex_convection(c, grid.face(c, i, j, k));
    });
  return largest(error);
}

}  // namespace

TEST_CASE("a constant velocity is not convected", "[unit][fluid]") {
  const Grid grid{{5, 6, 7}, {0, 0, 0}, {1.0, 1.5, 0.7}};
  FaceField N =
      convection(test::field_of(grid, [](int c, const Vec3&) { return 300.0 - 200.0 * c; }), grid);
  CHECK(largest(N) < 1e-10);  // rounding of fluxes of 1e5 over a cell
}

TEST_CASE("convection is second-order accurate", "[unit][fluid]") {
  const double coarse = error_of_vortex(16);
  const double fine = error_of_vortex(32);
  CHECK(coarse < 0.1);  // of a convection of size 2
  CHECK(coarse / fine > 3.5);
  CHECK(coarse / fine < 6.0);  // the upwind part vanishes with the third order
}

TEST_CASE("convection is damped the most where velocity changes from point to point",
          "[unit][fluid]") {
  // v = (-1)^i carried by u = a: all central fluxes vanish, the upwind part leaves 4/3 |a|/h v
  const Grid grid = cube(8);
  for (const double a : {2.0, -2.0}) {
    const FaceField velocity = test::field_of(grid, [&](int c, const Vec3& x) {
      const int i = static_cast<int>(std::floor(x.x() / grid.spacing[0] + 1e-9));
      return c == 0 ? a : c == 1 ? 0.01 * (i % 2 == 0 ? 1.0 : -1.0) : 0.0;
    });
    const FaceField N = convection(velocity, grid);
    for (int i = 0; i < 8; ++i)
      CHECK(N.component[1].at(i, 4, 4) ==
            Approx(4.0 / 3.0 * 2.0 / grid.spacing[0] * velocity.component[1].at(i, 4, 4)));
  }
}

TEST_CASE("convection moves momentum about and makes none", "[unit][fluid]") {
  const Grid grid{{12, 10, 11}, {0, 0, 0}, {1.0, 1.5, 0.7}};
  test::RandomValues random(1);
  // nothing moves within three points of the sides: no flux leaves
  FaceField velocity(grid, test::whole_box(grid));
  for (fluid::Component& u : velocity.component)
    test::for_points(u, -3, [&](int, int, int, double& value) { value = random(); });
  FaceField N = convection(velocity, grid);
  CHECK(largest(N) > 0.1);
  for (fluid::Component& u : N.component) {
    double sum = 0.0;
    test::for_points(u, 0, [&](int, int, int, double& value) { sum += value; });
    CHECK(std::abs(sum) < 1e-12);  // rounding of some hundred terms of size one
  }
}

TEST_CASE("the force extrapolates the convection of two times", "[unit][fluid]") {
  const Grid grid = cube(8);
  const FaceField first = test::field_of(grid, vortex);
  const FaceField second =
      test::field_of(grid, [](int c, const Vec3& x) { return 1.3 * vortex(c, x) + 0.1; });
  FaceField N_first = convection(first, grid);
  FaceField N_second = convection(second, grid);
  FaceField previous(grid, test::whole_box(grid));
  FaceField force(grid, test::whole_box(grid));
  fluid::convection_force(first, grid, 1.06, {1.0, 0.0}, previous, force);
  fluid::convection_force(second, grid, 1.06, {1.5, -0.5}, previous, force);
  for (int c = 0; c < 3; ++c)
    test::for_points(force.component[c], 0, [&](int i, int j, int k, double& f) {
      const double expected = -1.06 * (1.5 * N_second.component[c].at(i, j, k) -
                                       0.5 * N_first.component[c].at(i, j, k));
      CHECK(f == Approx(expected).margin(1e-13));
    });
}
