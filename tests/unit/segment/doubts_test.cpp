#include "lv/segment/doubts.hpp"

#include "lv/base/check.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

using namespace lv;
using segment::Segmentation;

namespace {

constexpr std::size_t frames = 10;
constexpr std::size_t all_slices = 7;  // the first above the base, the last below the tip
constexpr double wall_area = 1500.0;   // [mm^2]
const std::vector<std::size_t> shown{1, 2, 3, 4, 5};

double radius_of(double area_within) {
  return std::sqrt(area_within / std::numbers::pi);
}

image::Cine images(int pixels) {
  image::Cine cine;
  image::Picture picture;
  picture.plane.columns = picture.plane.rows = pixels;
  picture.values.assign(static_cast<std::size_t>(pixels) * pixels, 0.0F);
  cine.slices.resize(all_slices);
  for (std::size_t s = 0; s < all_slices; ++s) {
    picture.plane.origin.z() = 8.0 * static_cast<double>(s);
    cine.slices[s].frames.assign(frames, picture);
  }
  return cine;
}

/// Circles in the middle of images of 200 pixels of 1 mm, smaller towards the tip, which shrink to
/// half of their area at frame 4 and grow again.
Segmentation beating() {
  Segmentation found;
  found.spacing = 8.0;
  found.volumes.assign(frames, 0.0);
  found.shows.assign(all_slices, std::vector<char>(frames, 0));
  found.borders.resize(all_slices);
  for (const std::size_t s : shown) {
    found.borders[s].centre = {100.0, 100.0};
    for (std::size_t t = 0; t < frames; ++t) {
      const double systole =
          0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * static_cast<double>(t) / (frames - 2.0)));
      const double cavity = 2000.0 * (1.0 - 0.18 * (static_cast<double>(s) - 1.0)) *
                            (t < 9 ? 1.0 - 0.5 * systole : 1.0);
      segment::FrameBorders frame;
      frame.endo = segment::Radii::Constant(96, radius_of(cavity));
      frame.epi = segment::Radii::Constant(96, radius_of(cavity + wall_area));
      frame.wall_part = frame.endo_agrees = frame.epi_agrees = 1.0;
      found.borders[s].frames.push_back(frame);
      found.shows[s][t] = 1;
      found.volumes[t] += found.spacing * cavity;
    }
  }
  for (segment::SliceBorders& slice : found.borders)
    slice.frames.resize(frames,
                        {segment::Radii::Constant(96, 1.0), segment::Radii::Constant(96, 2.0)});
  found.phases = image::propose_phases(found.volumes);
  return found;
}

/// How many sentences have these words.
std::size_t said(const std::vector<std::string>& sentences, const std::string& words) {
  return static_cast<std::size_t>(std::count_if(
      sentences.begin(), sentences.end(),
      [&](const std::string& sentence) { return sentence.find(words) != std::string::npos; }));
}

}  // namespace

TEST_CASE("a ventricle that is whole in its images is not doubted", "[unit][segment]") {
  CHECK(segment::doubts_of_drawn(images(200), shown, beating()).empty());
  CHECK(segment::warnings_of_drawn(images(200), shown, beating()).empty());
}

TEST_CASE("a stack that ends within the ventricle is said to", "[unit][segment]") {
  const Segmentation whole = beating();
  Segmentation cut = whole;
  cut.borders = {whole.borders.begin() + 1, whole.borders.begin() + 4};
  cut.shows = {whole.shows.begin() + 1, whole.shows.begin() + 4};
  image::Cine cine = images(200);
  cine.slices.resize(3);
  const auto warnings = segment::warnings_of_drawn(cine, {0, 1, 2}, cut);
  CHECK(said(warnings, "slice 1 is the last image towards the base") == 1);
  CHECK(said(warnings, "slice 3 is the last image towards the tip") == 1);
  CHECK(said(warnings, "64% of the largest slice's area: the tip is not shown") == 1);
}

TEST_CASE("a border at the edge of its image is doubted", "[unit][segment]") {
  const auto warnings = segment::warnings_of_drawn(images(132), shown, beating());
  REQUIRE(said(warnings, "the image cuts the ventricle off") == 1);
  CHECK(said(warnings, "slices 2 to 3: up to ") == 1);
}

TEST_CASE("muscle that does not keep its volume is doubted, with the moments it is of",
          "[unit][segment]") {
  Segmentation found = beating();
  const auto early = static_cast<std::size_t>(found.phases.early_diastole);
  for (const std::size_t s : shown) {
    segment::FrameBorders& frame = found.borders[s].frames[early];
    frame.epi.setConstant(radius_of(segment::area(frame.endo) + 1.3 * wall_area));
  }
  const auto warnings = segment::warnings_of_drawn(images(200), shown, found);
  CHECK(warnings.size() == 2);
  CHECK(said(warnings, "60 to 78 ml of muscle") == 1);
  CHECK(said(warnings, "the borders hold 78 ml of muscle at early diastole (phase " +
                           std::to_string(early + 1) + ") and 60 ml at end-diastole") == 1);
}

TEST_CASE("a cine in which nothing beats, or that ends with end-systole, is doubted",
          "[unit][segment]") {
  Segmentation found = beating();
  Segmentation still = found;
  still.volumes.assign(frames, found.volumes[0]);
  still.phases = image::propose_phases(still.volumes);
  CHECK(said(segment::warnings_of_drawn(images(200), shown, still), "nothing is seen to beat") ==
        1);
  found.phases.early_diastole = found.phases.end_systole;
  CHECK(said(segment::warnings_of_drawn(images(200), shown, found),
             "the cine ends before the ventricle fills") == 1);
}

TEST_CASE("a doubtful border says where it is least sure", "[unit][segment]") {
  Segmentation found = beating();
  const auto systole = static_cast<std::size_t>(found.phases.end_systole);
  found.borders[2].frames[systole].endo_agrees = 0.0;
  found.borders[2].frames[systole + 1].endo_agrees = 0.5;
  found.borders[3].frames[1].epi_agrees = 0.4;
  const auto doubts = segment::doubts_of_drawn(images(200), shown, found);
  CHECK(said(doubts,
             "slice 3: the endocardium is doubtful in phases 5 to 6, least sure in phase 5, "
             "end-systole: confidence 0.00 of 1") == 1);
  CHECK(said(doubts, "slice 4: the epicardium is doubtful in phase 2, confidence 0.40 of 1") == 1);
}

TEST_CASE("fluid and a wall too thick are named with their slices", "[unit][segment]") {
  Segmentation found = beating();
  CHECK(said(segment::doubts_of_drawn(images(200), shown, found), "fluid") == 0);
  found.borders[2].fluid_part = found.borders[3].fluid_part = 0.5;
  for (segment::FrameBorders& frame : found.borders[4].frames)
    frame.epi.head(30) = frame.endo.head(30) + 16.0;
  const auto doubts = segment::doubts_of_drawn(images(200), shown, found);
  CHECK(said(doubts, "slices 3 to 4: outside the muscle an even layer") == 1);
  CHECK(said(doubts, "slice 5: the wall is drawn thicker than 15 mm at end-diastole") == 1);
}

TEST_CASE("papillary muscles that end-systole lacks are said with their volume",
          "[unit][segment]") {
  Segmentation found = beating();
  const auto diastole = static_cast<std::size_t>(found.phases.end_diastole);
  const auto systole = static_cast<std::size_t>(found.phases.end_systole);
  for (const std::size_t s : shown) {
    found.borders[s].frames[diastole].dark_within = 150.0;
    found.borders[s].frames[systole].dark_within = 120.0;
  }
  CHECK(segment::doubts_of_drawn(images(200), shown, found).empty());
  for (const std::size_t s : shown)
    found.borders[s].frames[systole].dark_within = 20.0;
  const auto doubts = segment::doubts_of_drawn(images(200), shown, found);
  CHECK(said(doubts,
             "6.0 ml of papillary muscles and trabeculae lie within the endocardium at "
             "end-diastole and 0.8 ml at end-systole") == 1);
}

TEST_CASE("an end-systole too narrow for its pixels is said to be", "[unit][segment]") {
  Segmentation found = beating();
  const auto systole = static_cast<std::size_t>(found.phases.end_systole);
  found.volumes[systole] = 0.0;
  for (const std::size_t s : shown) {
    found.borders[s].frames[systole].endo.setConstant(4.0);
    found.volumes[systole] += found.spacing * segment::area(found.borders[s].frames[systole].endo);
  }
  const auto doubts = segment::doubts_of_drawn(images(200), shown, found);
  CHECK(said(doubts, "half a pixel all round is 25% of its 2.0 ml") == 1);
}

TEST_CASE("muscle of a slice that the base leaves is not missed", "[unit][segment]") {
  Segmentation found = beating();
  const auto change_systole = [&](double factor) {
    for (const std::size_t s : shown) {
      segment::FrameBorders& frame =
          found.borders[s].frames[static_cast<std::size_t>(found.phases.end_systole)];
      frame.epi.setConstant(radius_of(segment::area(frame.endo) + factor * wall_area));
    }
  };
  change_systole(0.8);
  CHECK(said(segment::warnings_of_drawn(images(200), shown, found), "ml of muscle") == 2);
  // the same muscle, where the base has left a slice: half of one may be missing
  found.shows[1][static_cast<std::size_t>(found.phases.end_systole)] = 0;
  change_systole(1.0);
  CHECK(said(segment::warnings_of_drawn(images(200), shown, found), "ml of muscle") == 0);
  change_systole(0.9);
  CHECK(said(segment::warnings_of_drawn(images(200), shown, found), "ml of muscle") == 2);
}

TEST_CASE("an end-systole that holds more than end-diastole is refused", "[unit][segment]") {
  Segmentation found = beating();
  segment::require_emptying(found, "images", "Draw");
  std::swap(found.phases.end_diastole, found.phases.end_systole);
  CHECK_THROWS_AS(segment::require_emptying(found, "images", "Draw"), InputError);
}
