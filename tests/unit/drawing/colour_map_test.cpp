#include "lv/drawing/colour_map.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using lv::drawing::category;
using lv::drawing::Colour;

double linear(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double encoded(double c) {
  c = std::clamp(c, 0.0, 1.0);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

/// What an eye without red (0) or green (1) cones sees: Machado et al., IEEE TVCG 15:1291, 2009.
Colour seen_without(int cone, const Colour& c) {
  constexpr double m[2][3][3] = {{{0.152286, 1.052583, -0.204868},
                                  {0.114503, 0.786281, 0.099216},
                                  {-0.003882, -0.048116, 1.051998}},
                                 {{0.367322, 0.860646, -0.227968},
                                  {0.280085, 0.672501, 0.047413},
                                  {-0.011820, 0.042940, 0.968881}}};
  const auto part = [&](int i) {
    const auto& row = m[cone][i];
    return encoded(row[0] * linear(c.r) + row[1] * linear(c.g) + row[2] * linear(c.b));
  };
  return {part(0), part(1), part(2)};
}

double distance(const Colour& p, const Colour& q) {
  return std::hypot(p.r - q.r, p.g - q.g, p.b - q.b);
}

}  // namespace

TEST_CASE("lightness is that of CIE for black, white and middle grey", "[unit][drawing]") {
  CHECK(lv::drawing::lightness({0.0, 0.0, 0.0}) == Approx(0.0).margin(1e-12));
  CHECK(lv::drawing::lightness({1.0, 1.0, 1.0}) == Approx(100.0));
  CHECK(lv::drawing::lightness(lv::drawing::hex(0x777777)) == Approx(50.0).margin(0.1));
}

TEST_CASE("the sequential map grows evenly lighter", "[unit][drawing]") {
  const auto map = lv::drawing::sequential();
  for (int i = 1; i <= 100; ++i) {
    const double step =
        lv::drawing::lightness(map(i / 100.0)) - lv::drawing::lightness(map((i - 1) / 100.0));
    CHECK(step == Approx(0.72).margin(0.4));  // two or three of the table's 256 entries
  }
}

TEST_CASE("the diverging map is equally light on both sides of its middle", "[unit][drawing]") {
  const auto map = lv::drawing::diverging();
  for (int i = 0; i <= 50; ++i) {
    const double left = lv::drawing::lightness(map(0.5 - i / 100.0));
    const double right = lv::drawing::lightness(map(0.5 + i / 100.0));
    CHECK(left == Approx(right).margin(1.5));
    CHECK(left == Approx(95.0 - 65.0 * i / 50.0).margin(1.5));
  }
}

TEST_CASE("colour-blind eyes tell the eight categories apart", "[unit][drawing]") {
  for (const int cone : {0, 1})
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < i; ++j)
        // 0.1 is some 25 of 255 steps
        CHECK(distance(seen_without(cone, category(i)), seen_without(cone, category(j))) > 0.1);
}

TEST_CASE("a colour scale clamps, and has no colour for a missing value", "[unit][drawing]") {
  const lv::drawing::ColourScale scale{.min = 10.0, .max = 20.0};
  CHECK(distance(*scale(5.0), scale.map(0.0)) == 0.0);
  CHECK(distance(*scale(15.0), scale.map(0.5)) == 0.0);
  CHECK(distance(*scale(99.0), scale.map(1.0)) == 0.0);
  CHECK_FALSE(scale(std::numeric_limits<double>::quiet_NaN()).has_value());
  const lv::drawing::ColourScale constant{.min = 3.0, .max = 3.0};
  CHECK(distance(*constant(3.0), constant.map(0.5)) == 0.0);
}

TEST_CASE("what is nearer than the floor to the middle has no colour of the map",
          "[unit][drawing]") {
  const lv::drawing::ColourScale scale{
      .map = lv::drawing::diverging(), .min = 0.9, .max = 1.1, .middle = 1.0, .floor = 0.01};
  for (const double value : {0.991, 1.0, 1.009})
    CHECK(distance(*scale(value), lv::drawing::uncoloured) == 0.0);
  for (const double value : {0.9, 0.98, 1.02, 1.1})
    CHECK(distance(*scale(value), scale.map(scale.place(value))) == 0.0);
  CHECK(scale.place(0.95) == Approx(0.25));
}

TEST_CASE("where the map begins at the middle, what is below it has no colour either",
          "[unit][drawing]") {
  const lv::drawing::ColourScale scale{.min = 0.0, .max = 1.0, .floor = 0.005};
  for (const double value : {-0.03, 0.0, 0.004})
    CHECK(distance(*scale(value), lv::drawing::uncoloured) == 0.0);
  CHECK(distance(*scale(0.006), scale.map(0.006)) == 0.0);
  CHECK(scale.is_nothing(-0.03));
  CHECK_FALSE(scale.is_nothing(0.006));
  CHECK_FALSE(scale.is_nothing(std::nan("")));
}
