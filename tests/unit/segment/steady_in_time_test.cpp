#include "lv/segment/steady_in_time.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace lv;
using segment::Radii;

namespace {

/// The radius of a cavity over a cycle that is seen in a few frames: 26 mm, and 17 mm at its only
/// end-systolic frame.
const std::vector<double> coarse{26.0, 22.0, 17.0, 22.0, 24.5, 25.5};

std::vector<Radii> circles(const std::vector<double>& radii) {
  std::vector<Radii> lines;
  for (const double r : radii)
    lines.push_back(Radii::Constant(8, r));
  return lines;
}

}  // namespace

TEST_CASE("a cycle in twenty frames is steady, and a frame that stands off is not", "[segment]") {
  std::vector<double> radii;
  for (int t = 0; t < 20; ++t)
    radii.push_back(22.0 + 4.0 * std::cos(0.1 * std::numbers::pi * t));
  CHECK(segment::steady(radii) == radii);
  std::vector<double> off = radii;
  off[7] += 3.0;
  CHECK(std::abs(segment::steady(off)[7] - radii[7]) < 0.5);
}

TEST_CASE("motion that all slices share in few frames is kept", "[segment]") {
  CHECK(segment::steady(coarse)[2] > 17.9);  // straight lines take it for a frame that stands off
  const std::vector<double> motion = segment::shared_motion({coarse, coarse, coarse}, 1);
  CHECK(segment::steady_in_time(circles(coarse), motion)[2](0) == 17.0);
}

TEST_CASE("a slice or a ray that stands off alone is steadied in few frames too", "[segment]") {
  const std::vector<double> still(6, 24.0);
  std::vector<double> one = still;
  one[2] = 17.0;
  CHECK(segment::shared_motion({still, one, still}, 1)[2] == 0.0);
  CHECK(segment::steady_in_time(circles(one),
                                segment::shared_motion({still, one, still}, 1))[2](3) == 24.0);
  // of a ray that goes outwards while all go in nothing is kept, of one that goes in too far as
  // much as twice the mean motion
  const std::vector<double> motion = segment::shared_motion({coarse, coarse, coarse}, 0);
  std::vector<Radii> lines = circles(coarse);
  lines[2](3) = 30.0;
  lines[2](5) = 5.0;
  const Radii steadied = segment::steady_in_time(lines, motion)[2];
  CHECK(steadied(3) == 22.0);
  CHECK(steadied(5) == Approx(18.0 - 2.0));
  CHECK(steadied(0) == 17.0);
}

TEST_CASE("where scar stands still the rest of a wall moves on as it is seen", "[segment]") {
  std::vector<Radii> lines;
  std::vector<double> means;
  for (const double r : coarse) {
    Radii line = Radii::Constant(8, 26.0);
    line.head(4).setConstant(r);
    means.push_back(line.mean());
    lines.push_back(line);
  }
  const std::vector<double> motion = segment::shared_motion({means, means, means}, 2);
  const Radii kept = segment::steady_in_time(lines, motion)[2];
  CHECK(kept(0) == Approx(17.0));
  CHECK(kept(6) == 26.0);
}
