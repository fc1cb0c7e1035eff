#include "lv/geometry/star_surface.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace {

using lv::Vec3;
using namespace lv::geometry;
using std::numbers::pi;

constexpr Spheroid spheroid{20.0, 55.0, -12.0};

/// A surface with bumps in both directions that are smooth at the pole.
StarSurface bumpy(double height) {
  const CubicBasis along(CubicBasis::Ends::clamped, 9, 2.2);
  const CubicBasis around(CubicBasis::Ends::periodic, 12, 2.0 * pi);
  Eigen::MatrixXd c = Eigen::MatrixXd::Ones(along.size(), around.size());
  for (int k = 3; k < c.rows(); ++k)
    for (int j = 0; j < c.cols(); ++j)
      c(k, j) += height * std::sin(1.1 * k + 0.4) * std::cos(2.0 * pi * 2 * j / c.cols() + 0.7 * k);
  return {spheroid, along, around, c};
}

}  // namespace

TEST_CASE("polar coordinates of a spheroid and back are the same point", "[unit][geometry]") {
  for (const Vec3& x : {Vec3(3.0, -7.0, -50.0), Vec3(-12.0, 0.5, 4.0), Vec3(0.0, 0.0, -60.0)})
    CHECK((cartesian(spheroid, polar(spheroid, x)) - x).norm() < 1e-12);
}

TEST_CASE("a spheroid encloses the volume of its formula", "[unit][geometry]") {
  const auto primitive = [](double h) { return h - h * h * h / (3.0 * 55.0 * 55.0); };
  const double expected = pi * 20.0 * 20.0 * (primitive(12.0) - primitive(-55.0));
  CHECK(bumpy(0.0).enclosed_volume() == Approx(expected).epsilon(1e-9));
}

TEST_CASE("the volume of a bumpy surface is that of its facets", "[unit][geometry]") {
  const StarSurface surface = bumpy(0.04);
  constexpr int rows = 400;
  constexpr int angles = 400;
  const auto point = [&](int i, int j) {
    const double theta = 2.0 * pi * j / angles;
    return surface.point(surface.base_angle(theta) * i / rows, theta);
  };
  double volume = 0.0;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < angles; ++j) {
      const Vec3 a = point(i, j);
      const Vec3 b = point(i, j + 1);
      const Vec3 c = point(i + 1, j + 1);
      const Vec3 d = point(i + 1, j);
      volume += (a.cross(b).dot(c) + a.cross(c).dot(d)) / 6.0;
    }
  CHECK(surface.enclosed_volume() == Approx(volume).epsilon(1e-4));  // facets cut corners
}

TEST_CASE("meridians end on the base plane", "[unit][geometry]") {
  const StarSurface surface = bumpy(0.04);
  REQUIRE(surface.is_sound());
  for (int j = 0; j < 100; ++j)
    CHECK(std::abs(surface.point(surface.base_angle(0.1 * j), 0.1 * j).z()) < 1e-10);
}

TEST_CASE("a surface that turns inside out is not sound", "[unit][geometry]") {
  // the splines flatten the bumps of their coefficients to about 0.65 of them
  CHECK(bumpy(1.2).is_sound());
  CHECK_FALSE(bumpy(2.0).is_sound());
}

TEST_CASE("the level's gradient is its derivative", "[unit][geometry]") {
  const StarSurface surface = bumpy(0.04);
  constexpr double h = 1e-5;
  for (const Vec3& x : {Vec3(3.0, -7.0, -50.0), Vec3(-12.0, 0.5, -3.0), Vec3(9.0, 9.0, -20.0)}) {
    const auto at = surface.level(x);
    for (int i = 0; i < 3; ++i) {
      const Vec3 e = h * Vec3::Unit(i);
      const double slope = (surface.level(x + e).value - surface.level(x - e).value) / (2.0 * h);
      CHECK(at.gradient[i] == Approx(slope).margin(1e-8));
    }
  }
}

TEST_CASE("the nearest point lies on the surface, straight below", "[unit][geometry]") {
  const StarSurface surface = bumpy(0.02);
  for (const double mu : {0.0, 0.05, 0.4, 1.2, 1.8})
    for (const double offset : {-3.0, -0.5, 0.5, 4.0}) {
      const Vec3 foot = surface.point(mu, 0.9);
      const Vec3 x = foot + offset * surface.normal(mu, 0.9);
      CHECK((surface.closest(x) - foot).norm() < 1e-6);
      CHECK(surface.distance(x) == Approx(offset).margin(1e-6));
    }
}
