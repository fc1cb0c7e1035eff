#include "lv/segment/grey_levels.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
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

TEST_CASE("the most frequent grey value moves as far as the values do", "[segment]") {
  const auto level = [](double shift) {
    std::vector<double> outside;
    for (int k = -60; k <= 60; ++k)  // most at 300, fewer to either side
      outside.insert(outside.end(), static_cast<std::size_t>(61 - std::abs(k)), 300.0 + shift + k);
    return segment::muscle_levels({outside, outside, outside}, {1000.0, 1000.0, 1000.0}).front();
  };
  CHECK(level(0.0) == Approx(300.0).margin(1.0));
  for (const double shift : {0.01, 0.1, 1.0, 5.0})  // a sixtieth of the range is 3.5
    CHECK(level(shift) - level(0.0) == Approx(shift).epsilon(0.1));
}

TEST_CASE("how bright blood is at the tip is told while the slice holds most of it", "[segment]") {
  const segment::PolarGrid grid{};
  std::vector<segment::Polar> frames;
  for (const double level : {600.0, 500.0, 300.0, 200.0, 250.0, 400.0, 550.0, 600.0})
    frames.push_back(segment::Polar::Constant(grid.rays, grid.radii, level));
  CHECK(segment::fullest_blood(frames, 8.0, grid) == Approx(600.0));
  CHECK(segment::guess_levels(frames, 8.0, grid).blood == Approx(500.0));
}

TEST_CASE("muscle half as bright as blood has its usual contrast afterwards", "[segment]") {
  const segment::Contrast contrast = segment::contrast_of({50.0, 60.0, 40.0}, {100, 120, 80});
  const auto seen = [&](double v) { return segment::with_usual_contrast(v, contrast); };
  CHECK(seen(100.0) == Approx(100.0));
  CHECK(seen(75.0) == Approx(64.0));  // half way stays half way
  CHECK(seen(50.0) == Approx(28.0));
  CHECK(seen(25.0) == Approx(28.0 * 0.28));  // half of the muscle's: g is ln(0.28)/ln(0.5)
  CHECK(seen(0.0) == 0.0);
  CHECK(seen(-3.0) == 0.0);
  CHECK(segment::with_usual_contrast(25.0, {100.0, 20.0}) == 25.0);
}
