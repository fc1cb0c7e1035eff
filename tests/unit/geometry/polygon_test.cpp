#include "lv/geometry/polygon.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace {

using namespace lv;

/// The corners of a regular polygon, turned by some of its rays, so that rays go through corners.
geometry::Polygon regular(int corners, double radius) {
  geometry::Polygon line;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / corners;
    line.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return line;
}

}  // namespace

TEST_CASE("a ray through a corner of a line crosses it there", "[unit][geometry]") {
  constexpr int rays = 72;
  for (const int corners : {72, 180, 360})
    for (double radius = 7.0; radius < 40.0; radius += 0.37) {
      const geometry::Polygon line = regular(corners, radius);
      for (int k = 0; k < rays; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / rays;
        INFO(corners << " corners, radius " << radius << ", ray " << k);
        CHECK(geometry::farthest_crossing(line, {std::cos(angle), std::sin(angle)}) ==
              Approx(radius).epsilon(1e-3));
      }
    }
}

TEST_CASE("a ray that meets nothing crosses nothing", "[unit][geometry]") {
  const geometry::Polygon beside{{10.0, -1.0}, {12.0, -1.0}, {12.0, 1.0}, {10.0, 1.0}};
  CHECK(geometry::farthest_crossing(beside, {0.0, 1.0}) == 0.0);
  CHECK(geometry::farthest_crossing(beside, {1.0, 0.0}) == Approx(12.0));
}
