#include "lv/segment/grey_levels.hpp"

#include <catch2/catch.hpp>

#include <vector>

using namespace lv;

TEST_CASE("the blood of a slice at the tip is as bright as the study's", "[segment]") {
  // three times as bright as muscle, but for the tip, which holds muscle too
  const std::vector<double> whole = segment::whole_blood({900.0, 900.0, 600.0, 450.0, 960.0},
                                                         {300.0, 300.0, 200.0, 250.0, 300.0});
  CHECK(whole.at(0) == Approx(900.0));
  CHECK(whole.at(2) == Approx(600.0));  // farther from the coil: muscle is darker there as well
  CHECK(whole.at(3) == Approx(750.0));
  CHECK(whole.at(4) == Approx(960.0));
}

TEST_CASE("how bright blood is at the tip is told while the slice holds most of it", "[segment]") {
  const segment::PolarGrid grid{};
  std::vector<segment::Polar> frames;
  for (const double level : {600.0, 500.0, 300.0, 200.0, 250.0, 400.0, 550.0, 600.0})
    frames.push_back(segment::Polar::Constant(grid.rays, grid.radii, level));
  CHECK(segment::fullest_blood(frames, 8.0, grid) == Approx(600.0));
  CHECK(segment::guess_levels(frames, 8.0, grid).blood == Approx(500.0));
}
