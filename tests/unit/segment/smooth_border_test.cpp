#include "lv/segment/smooth_border.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace lv;
using segment::Radii;

TEST_CASE("the chord of a quarter of a circle is nearest in its middle", "[segment]") {
  const double quarter = 0.5 * std::numbers::pi;
  CHECK(segment::chord(10.0, 10.0, 0.5 * quarter, quarter) == Approx(10.0 / std::sqrt(2.0)));
  CHECK(segment::chord(10.0, 4.0, 0.0, quarter) == Approx(10.0));
  CHECK(segment::chord(10.0, 4.0, quarter, quarter) == Approx(4.0));
}

TEST_CASE("a border is closed straight where no muscle is seen", "[segment]") {
  const Radii circle = Radii::Constant(72, 20.0);
  Radii sees = Radii::Ones(72);
  for (const int ray : {70, 71, 0, 1, 2, 3, 4})  // an opening over 40 degrees
    sees(ray) = 0.0;
  const Radii closed = segment::closed_straight(circle, circle, sees);
  CHECK(closed(1) == Approx(20.0 * std::cos(std::numbers::pi / 9.0)));
  CHECK(closed(5) == 20.0);
  CHECK(closed(36) == 20.0);
  // what lies within the chord already stays
  CHECK(segment::closed_straight(0.5 * circle, circle, sees)(1) == 10.0);
}

TEST_CASE("a border behind which muscle is seen over less than half a turn is not cut",
          "[segment]") {
  const Radii circle = Radii::Constant(72, 20.0);
  Radii sees = Radii::Zero(72);
  sees.head(30).setOnes();
  CHECK((segment::closed_straight(circle, circle, sees) == circle).all());
}

TEST_CASE("a stiff border is still a circle, and bends less towards papillary muscles",
          "[segment]") {
  const Radii one = Radii::Ones(72);
  Radii seen = 20.0 * one;
  const auto fitted = [&](double stiffness) {
    return segment::fit_border({seen, one, seen, 0.0 * one, 3, 0.1, stiffness});
  };
  CHECK((fitted(10.0) - 20.0).abs().maxCoeff() < 1e-9);
  for (const int ray : {0, 24, 48})  // three columns over 50 degrees each
    for (int d = 0; d < 10; ++d)
      seen(ray + d) = 14.0;
  CHECK(fitted(0.3).minCoeff() > fitted(0.0).minCoeff());
  CHECK(fitted(10.0).minCoeff() > fitted(0.3).minCoeff());
}
