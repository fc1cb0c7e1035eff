#include "lv/segment/fluid.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace lv;
using segment::Polar;
using segment::Radii;

namespace {

constexpr segment::PolarGrid fluid_grid{};
constexpr double endo = 25.0;
constexpr double muscle_ends = 34.0;
constexpr double epi = 42.0;  // as drawn

/// Brightness along all rays, `outside` at a distance from the muscle's end; 1 within the
/// endocardium, and a ripple of a thirtieth.
template <class Outside>
Radii fluid_of(const Outside& outside) {
  Polar brightness(fluid_grid.rays, fluid_grid.radii);
  for (int i = 0; i < fluid_grid.rays; ++i)
    for (int k = 0; k < fluid_grid.radii; ++k) {
      const double r = fluid_grid.radius(k);
      brightness(i, k) = (r < endo          ? 1.0
                          : r < muscle_ends ? 0.0
                                            : outside(i, r - muscle_ends)) +
                         0.03 * std::sin(2.0 * i + 3.0 * k);
    }
  return segment::fluid_within({brightness, brightness},
                               {2, Radii::Constant(fluid_grid.rays, endo)},
                               {2, Radii::Constant(fluid_grid.rays, epi)}, fluid_grid);
}

}  // namespace

TEST_CASE("an even layer outside the muscle and a little brighter is fluid", "[segment]") {
  const Radii fluid = fluid_of([](int, double) { return 0.15; });
  CHECK(fluid.minCoeff() == Approx(0.15).margin(0.02));
  CHECK(fluid.maxCoeff() == Approx(0.15).margin(0.02));
}

TEST_CASE("fluid is found where it lies round the heart", "[segment]") {
  const Radii fluid = fluid_of([](int ray, double) { return ray < 36 ? 0.15 : 0.0; });
  CHECK((fluid.segment(4, 28) > 0.1).all());
  CHECK((fluid.segment(40, 28) == 0.0).all());
}

TEST_CASE("neither muscle alone nor its blurred edge is fluid", "[segment]") {
  CHECK(fluid_of([](int, double) { return 0.0; }).maxCoeff() == 0.0);
  CHECK(fluid_of([](int, double away) { return 0.06 * away; }).maxCoeff() == 0.0);
  CHECK(fluid_of([](int, double) { return -0.2; }).maxCoeff() == 0.0);
}
