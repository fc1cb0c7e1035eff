#include "lv/segment/ring.hpp"

#include <catch2/catch.hpp>

using namespace lv;
using segment::Polar;
using segment::Radii;

namespace {

constexpr segment::PolarGrid ring_grid{};

/// Darkness of a wall from 20 to 28 mm along the first rays.
Polar wall_on(int rays) {
  Polar darkness = Polar::Zero(ring_grid.rays, ring_grid.radii);
  for (int i = 0; i < rays; ++i)
    for (int k = ring_grid.index(20.0); k < ring_grid.index(28.0); ++k)
      darkness(i, k) = 1.0;
  return darkness;
}

}  // namespace

TEST_CASE("a ring of muscle within a border is found, papillary muscles are none", "[segment]") {
  const Radii border = Radii::Constant(ring_grid.rays, 40.0);
  const auto ring = segment::ring_within(wall_on(60), border, ring_grid);
  REQUIRE(ring);
  CHECK((*ring)(10) == Approx(28.0).margin(ring_grid.step));
  CHECK((*ring)(70) == ring_grid.last());
  CHECK_FALSE(segment::ring_within(wall_on(30), border, ring_grid));
  CHECK_FALSE(segment::ring_within(wall_on(72), Radii::Constant(ring_grid.rays, 20.0), ring_grid));
}
