#include "lv/segment/edge_width.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace lv;
using segment::PolarGrid;

namespace {

/// Darkness of an edge at 20 mm whose point spread has a deviation [mm].
segment::Polar edge(double sigma, const PolarGrid& grid) {
  segment::Polar dark(grid.rays, grid.radii);
  for (int i = 0; i < grid.rays; ++i)
    for (int k = 0; k < grid.radii; ++k)
      dark(i, k) = 0.5 * std::erfc(-(grid.radius(k) - 20.0) / (sigma * std::sqrt(2.0)));
  return dark;
}

/// As many widths, evenly from so much below to so much above the median.
std::vector<double> widths_round(double median, double below, double above) {
  std::vector<double> widths;
  for (int n = 0; n <= 1000; ++n) {
    const double at = 2.0 * n / 1000.0 - 1.0;
    widths.push_back(median + (at < 0.0 ? below : above) * at);
  }
  return widths;
}

}  // namespace

TEST_CASE("the width of a blurred edge is that of its point spread", "[segment]") {
  const PolarGrid grid;
  const segment::Radii wall = segment::Radii::Constant(grid.rays, 26.0);
  const segment::Radii widths = segment::edge_widths(edge(1.5, grid), wall, grid);
  // Phi^-1(0.85) = 1.0364; linear between radii half a deviation apart, hence 3%
  CHECK(widths(0) == Approx(1.0364 * 1.5).epsilon(0.03));
  CHECK(segment::edge_widths(1.0 - edge(1.5, grid), wall, grid)(0) < 0.0);
}

TEST_CASE("edges as sharp as the image put the border into their middle, wider ones further out",
          "[segment]") {
  CHECK(segment::darkness_at_border({}).likely == 0.5);
  CHECK(segment::darkness_at_border(widths_round(1.0, 0.2, 0.3)).if_sharp == 0.5);
  // pictures half as sharp as their pixels
  CHECK(segment::darkness_at_border(widths_round(2.0, 0.4, 0.6)).likely == 0.5);
  CHECK(segment::darkness_at_border(widths_round(2.0, 0.4, 0.6)).if_sharp ==
        Approx(0.925).margin(0.004));
  double before = 0.5;
  for (const double median : {1.2, 1.5, 2.0, 3.0}) {
    const double now =
        segment::darkness_at_border(widths_round(median, median - 0.7, median)).likely;
    CHECK(now > before);
    CHECK(now <= 0.95);
    before = now;
  }
}

TEST_CASE("a ramp twice as wide as the point spread makes ends at 0.92 of the way", "[segment]") {
  // the tenth is as sharp as the image; sqrt(4 - 0.2) = 1.95 is the edge of a ramp of 5.3
  // deviations, at whose end D(0) = Phi(5.3) - (phi(0) - phi(5.3))/5.3 = 0.925
  CHECK(segment::darkness_at_border(widths_round(2.0, 1.6, 1.6)).likely ==
        Approx(0.925).margin(0.004));
}
