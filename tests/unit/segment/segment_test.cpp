#include "lv/segment/segment.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/contour_table.hpp"
#include "lv/phantom/random.hpp"
#include "lv/segment/borders.hpp"
#include "lv/segment/coils.hpp"
#include "lv/segment/redraw.hpp"
#include "lv/strain/measures.hpp"

#include "segment/agreement.hpp"
#include "segment/variations.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numbers>
#include <optional>

using namespace lv;
using geometry::Contour;
using geometry::Side;

namespace {

using test::Agreement;
using test::agreement;

void tell(const std::string& what, const Agreement& a) {
  fmt::print("{}: Dice {:.3f}, distance {:.4f} mm, volume {:+.1f}%, {} of {} loops missed\n", what,
             a.dice, a.distance, 100.0 * a.volume, a.missed, a.loops);
}

/// The point of a true line that is farthest from a drawn one.
Vec3 farthest_of(const std::vector<Vec3>& truth, const std::vector<Vec3>& drawn) {
  const auto away = [&](const Vec3& x) { return strain::distance({x}, {drawn}, true).mean; };
  return *std::max_element(truth.begin(), truth.end(),
                           [&](const Vec3& a, const Vec3& b) { return away(a) < away(b); });
}

/// What some points, each set where the line is farthest from the true one, and redrawing from them
/// make of the mean distance of the lines of a side.
void try_redrawing(const std::string& what, const image::Cine& cine,
                   const segment::Segmentation& found, std::size_t frame,
                   const geometry::Contours& truth, Side side) {
  const geometry::Contours drawn = segment::contours_at(cine, found, frame);
  constexpr int most_points = 3;
  std::array<double, most_points + 1> distance{};
  double slowest = 0.0;
  int loops = 0;
  for (const Contour& loop : truth.short_axis) {
    const Contour* endo = geometry::find(drawn.short_axis, loop.slice, Side::endo);
    const Contour* epi = geometry::find(drawn.short_axis, loop.slice, Side::epi);
    if (loop.side != side || endo == nullptr || epi == nullptr)
      continue;
    ++loops;
    segment::BorderWish wish{side, frame, {}, endo->points, epi->points};
    std::vector<Vec3>& line = side == Side::endo ? wish.endo : wish.epi;
    for (int n = 0;; ++n) {
      distance.at(n) += strain::distance(line, {loop.points}, true).mean;
      if (n == most_points)
        break;
      wish.points.push_back(farthest_of(loop.points, line));
      const auto began = std::chrono::steady_clock::now();
      line = segment::redraw(cine.slices[static_cast<std::size_t>(loop.slice - 1)], wish,
                             found.fall, what);
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
      slowest = std::max(slowest, took.count());
    }
  }
  fmt::print("{}, {}: mean distance {:.2f} mm as proposed", what, geometry::name(side),
             distance[0] / loops);
  for (int n = 1; n <= most_points; ++n)
    fmt::print(", {:.2f} through {}", distance.at(n) / loops, n);
  fmt::print(" points; slowest {:.0f} ms\n", 1e3 * slowest);
  CHECK(distance[1] < distance[0]);
  CHECK(distance[most_points] < 0.8 * distance[0]);
}

/// A ring of muscle round blood of 25 mm radius, 9 mm thick; outside it lung on the left, and on
/// the right liver, as bright as muscle, behind a line of 2 mm that is as bright as a part of
/// muscle. Coils receive exp(g . x) at x from the middle [mm].
image::Picture ring_beside_liver(double line, const segment::CoilGradient& g) {
  constexpr double blood = 1000.0;  // five times the muscle's, as in sharp images of today
  constexpr double muscle = 200.0;
  image::Picture picture;
  image::Plane& plane = picture.plane;
  plane.columns = plane.rows = 100;
  plane.spacing_i = plane.spacing_j = 1.4;
  for (int j = 0; j < plane.rows; ++j)
    for (int i = 0; i < plane.columns; ++i) {
      const double r = 1.4 * std::hypot(i - 50, j - 50);
      const double outside = i < 50 ? 0.2 * muscle : r < 36.0 ? line * muscle : muscle;
      const double received = std::exp(g.dot(1.4 * segment::CoilGradient(i - 50, j - 50)));
      picture.values.push_back(static_cast<float>(received * (r < 25.0   ? blood
                                                              : r < 34.0 ? muscle
                                                                         : outside)));
    }
  return picture;
}

/// The same with blood instead of all that lies within 35 degrees of the ring's right.
image::Picture open_ring() {
  image::Picture picture = ring_beside_liver(0.5, segment::CoilGradient::Zero());
  const image::Plane& plane = picture.plane;
  for (int j = 0; j < plane.rows; ++j)
    for (int i = 50; i < plane.columns; ++i)
      if (std::abs(j - 50) < std::tan(35.0 * std::numbers::pi / 180.0) * (i - 50))
        picture.values[static_cast<std::size_t>(j) * plane.columns + i] = picture.at(50, 50);
  return picture;
}

/// A wall as thick as that of a hypertrophic ventricle at end-systole, 26 mm, between blood and
/// lung.
image::Picture thick_ring() {
  image::Picture picture = ring_beside_liver(0.5, segment::CoilGradient::Zero());
  for (int j = 0; j < picture.plane.rows; ++j)
    for (int i = 0; i < picture.plane.columns; ++i) {
      const double r = 1.4 * std::hypot(i - 50, j - 50);
      picture.values[static_cast<std::size_t>(j) * picture.plane.columns + i] = r < 14.0   ? 1000.0F
                                                                                : r < 40.0 ? 200.0F
                                                                                           : 40.0F;
    }
  return picture;
}

/// A ring of muscle round blood, 9 mm thick, in fluid of 12 mm that is so much of blood as bright,
/// and lung.
image::Picture ring_in_fluid(double fluid) {
  image::Picture picture = thick_ring();
  for (int j = 0; j < picture.plane.rows; ++j)
    for (int i = 0; i < picture.plane.columns; ++i) {
      const double r = 1.4 * std::hypot(i - 50, j - 50);
      picture.values[static_cast<std::size_t>(j) * picture.plane.columns + i] =
          static_cast<float>(1000.0 * (r < 25.0   ? 1.0
                                       : r < 34.0 ? 0.3
                                       : r < 46.0 ? fluid
                                                  : 0.06));
    }
  return picture;
}

/// Three slices that show a picture in each of five frames, but the second slice another in its
/// third.
image::Cine rings(const image::Picture& shown, const image::Picture& once) {
  image::Cine cine;
  cine.slices.assign(3, {"slice", {5, shown}, {}, 0.0});
  cine.slices[1].frames[2] = once;
  for (std::size_t s = 0; s < 3; ++s)
    for (image::Picture& picture : cine.slices[s].frames)
      picture.plane.origin.z() = 10.0 * static_cast<double>(s);
  return cine;
}

/// The borders of the second slice, drawn round the middle of the pictures.
std::vector<segment::FrameBorders> borders_in(const image::Cine& cine) {
  const segment::Centre middle{segment::Pixel(50.0, 50.0), 1.0, 25.0};
  return segment::draw_borders(cine, {{3, middle}, 1}, 0.5).slices[1].frames;
}

/// The borders that are drawn round the middle of a picture that three slices show.
segment::FrameBorders borders_of(const image::Picture& shown) {
  return borders_in(rings(shown, shown))[0];
}

segment::FrameBorders borders_beside_liver(
    double line, const segment::CoilGradient& g = segment::CoilGradient::Zero()) {
  return borders_of(ring_beside_liver(line, g));
}

/// A phantom of five phases, made once.
const test::KnownCine& five_phases() {
  static const test::KnownCine known = [] {
    phantom::Scan scan = test::noisy_scan(1);
    scan.phases = 5;
    return test::phantom_study("phantom", scan, 0.0);
  }();
  return known;
}

/// What a segmentation finds of the phantom at end-diastole and end-systole.
void try_phantom(std::uint32_t seed) {
  const test::KnownCine known = test::phantom_study("phantom", test::noisy_scan(seed), 0.0);
  const segment::Segmentation found = segment::segment(known.cine, {}, "phantom");
  CHECK(found.fall == Approx(0.5).margin(0.05));  // no trabeculae
  CHECK(found.phases.end_diastole == known.end_diastole);
  CHECK(found.phases.end_systole == known.end_systole);
  for (const int frame : {known.end_diastole, known.end_systole}) {
    const geometry::Contours drawn =
        segment::contours_at(known.cine, found, static_cast<std::size_t>(frame));
    const geometry::Contours& truth = known.truth.at(frame);
    const Agreement endo = agreement(drawn, truth, Side::endo);
    const Agreement epi = agreement(drawn, truth, Side::epi);
    tell(fmt::format("phantom {}, phase {}, endocardium", seed, frame + 1), endo);
    tell(fmt::format("phantom {}, phase {}, epicardium", seed, frame + 1), epi);
    CHECK(endo.pooled > 0.95);
    CHECK(endo.dice > 0.95);
    CHECK(std::abs(endo.volume) < 0.03);
    CHECK(epi.dice > 0.95);
    CHECK(test::dice_of_muscle(drawn, truth) > 0.90);
  }
}

/// The same with a rim of trabeculae. Its edge is no ramp but columns that fill three fifths at the
/// wall, so that less is asked of the volume.
void try_trabeculae(std::uint32_t seed) {
  const test::KnownCine known = test::phantom_study("phantom", test::noisy_scan(seed), 4.0);
  const segment::Segmentation found = segment::segment(known.cine, {}, "phantom");
  CHECK(found.fall > 0.7);
  for (const int frame : {known.end_diastole, known.end_systole}) {
    const Agreement endo =
        agreement(segment::contours_at(known.cine, found, static_cast<std::size_t>(frame)),
                  known.truth.at(frame), Side::endo);
    tell(fmt::format("phantom {} with trabeculae, phase {}, endocardium", seed, frame + 1), endo);
    CHECK(std::abs(endo.volume) < 0.05);
  }
}

/// A real study against the loops that observers drew, phases in their count.
void try_patient(const std::string& name, const std::string& images, int diastole, int systole) {
  const std::optional<test::KnownCine> known = test::patient(name, images, diastole, systole);
  if (!known) {
    WARN("skipped: no images of " << name);
    return;
  }
  const image::Cine& cine = known->cine;
  const segment::Segmentation found = segment::segment(cine, {}, name);
  const auto at = [&](int phase) {
    return segment::contours_at(cine, found, static_cast<std::size_t>(phase - 1));
  };
  const Agreement endo = agreement(at(diastole), known->truth.at(diastole - 1), Side::endo);
  const Agreement epi = agreement(at(diastole), known->truth.at(diastole - 1), Side::epi);
  const Agreement small = agreement(at(systole), known->truth.at(systole - 1), Side::endo);
  tell(name + ", end-diastole, endocardium", endo);
  tell(name + ", end-diastole, epicardium", epi);
  tell(name + ", end-systole, endocardium", small);
  fmt::print("{}: proposed end-diastole {}, end-systole {}, observers' {}, {}\n", name,
             found.phases.end_diastole + 1, found.phases.end_systole + 1, diastole, systole);
  for (const Side side : {Side::endo, Side::epi})
    try_redrawing(name + ", end-diastole", cine, found, static_cast<std::size_t>(diastole - 1),
                  known->truth.at(diastole - 1), side);
  try_redrawing(name + ", end-systole", cine, found, static_cast<std::size_t>(systole - 1),
                known->truth.at(systole - 1), Side::endo);
  CHECK(endo.dice > 0.90);
  CHECK(small.dice > 0.85);
  CHECK(epi.dice > 0.92);
  CHECK(std::abs(endo.volume) < 0.08);
  CHECK(std::abs(small.volume) < 0.12);
  CHECK(endo.distance < 2.0);
  CHECK(epi.distance < 2.0);
  CHECK(small.distance < 2.0);
}

}  // namespace

TEST_CASE("a phantom with papillary muscles, noise and shifts is segmented to 3%", "[segment]") {
  for (const std::uint32_t seed : {1U, 2U})
    try_phantom(seed);
}

TEST_CASE("end-systole that one of few frames shows is as small as in many", "[segment]") {
  for (const int phases : {5, 6}) {
    phantom::Scan scan = test::noisy_scan(1);
    scan.phases = phases;
    const test::KnownCine known = test::phantom_study("phantom", scan, 0.0);
    const segment::Segmentation found = segment::segment(known.cine, {}, "phantom");
    CHECK(found.phases.end_systole == known.end_systole);
    for (const int frame : {known.end_diastole, known.end_systole}) {
      const Agreement endo =
          agreement(segment::contours_at(known.cine, found, static_cast<std::size_t>(frame)),
                    known.truth.at(frame), Side::endo);
      tell(fmt::format("phantom of {} phases, phase {}, endocardium", phases, frame + 1), endo);
      CHECK(std::abs(endo.volume) < 0.03);
      CHECK(endo.pooled > 0.95);
    }
  }
}

TEST_CASE("a slice is left out for the reason that decided", "[segment]") {
  image::Cine cine = five_phases().cine;
  const segment::Segmentation whole = segment::segment(cine, {}, "phantom");
  // the slice at an end loses most of its contrast
  std::size_t end = 0;
  while (whole.shows[end][0] == 0)
    ++end;
  for (image::Picture& picture : cine.slices[end].frames)
    for (float& value : picture.values)
      value = 100.0F + 0.1F * value;
  const segment::Segmentation found = segment::segment(cine, {}, "phantom");
  const std::string about = fmt::format("slice {} is left out: ", end + 1);
  const auto doubt = std::find_if(found.doubts.begin(), found.doubts.end(),
                                  [&](const std::string& d) { return d.starts_with(about); });
  REQUIRE(doubt != found.doubts.end());
  CHECK_THAT(*doubt, Catch::Contains("of what they do in most slices"));
}

TEST_CASE("a slice that the base leaves to the atrium counts at end-diastole alone", "[segment]") {
  phantom::Scan scan = test::noisy_scan(1);
  scan.phases = 15;
  image::Cine cine = test::phantom_study("phantom", scan, 0.0).cine;
  const segment::Segmentation whole = segment::segment(cine, {}, "phantom");
  std::size_t basal = 0;
  while (whole.shows[basal][0] == 0)
    ++basal;
  ++basal;  // the first whose muscle goes all round
  const segment::Pixel centre = whole.borders[basal].centre;
  const auto diastole = static_cast<std::size_t>(whole.phases.end_diastole);
  const auto systole = static_cast<std::size_t>(whole.phases.end_systole);
  const std::size_t frames = cine.slices[basal].frames.size();
  for (std::size_t d = 3; d + 2 < frames; ++d) {  // but for two frames on either side
    image::Picture& picture = cine.slices[basal].frames[(diastole + d) % frames];
    const image::Plane& plane = picture.plane;
    const float blood = picture.at(static_cast<int>(centre.x()), static_cast<int>(centre.y()));
    for (int j = 0; j < plane.rows; ++j)
      for (int i = 0; i < plane.columns; ++i) {
        const double r = std::hypot(i - centre.x(), j - centre.y()) * plane.spacing_i;
        const bool lung = j < centre.y();
        picture.values[static_cast<std::size_t>(j) * plane.columns + i] =
            blood * (r < 22.0   ? 1.0F
                     : r < 24.0 ? 0.35F
                     : lung     ? 0.1F
                                : 1.1F);
      }
  }
  const segment::Segmentation found = segment::segment(cine, {}, "phantom");
  CHECK(found.shows[basal][diastole] != 0);
  CHECK(found.shows[basal][systole] == 0);
  const auto half = [&](std::size_t frame) {
    std::size_t slice = 0;
    while (found.shows[slice][frame] == 0)
      ++slice;
    const double area = segment::area(found.borders[slice].frames[frame].endo);
    return fmt::format("{:.1f} ml of {:.1f} at end-", 0.5e-3 * found.spacing * area,
                       1e-3 * found.volumes[frame]);
  };
  const std::string doubts = fmt::format("{}", fmt::join(found.doubts, "; "));
  CHECK_THAT(doubts, Catch::Contains(half(diastole) + "diastole"));
  CHECK_THAT(doubts, Catch::Contains(half(systole) + "systole"));
}

TEST_CASE("a slice that shows much more blood than the next towards the tip is left out",
          "[segment]") {
  image::Cine cine = five_phases().cine;
  const segment::Segmentation whole = segment::segment(cine, {}, "phantom");
  std::size_t basal = 0;
  while (whole.shows[basal][0] == 0)
    ++basal;
  for (std::size_t t = 0; t < cine.slices[basal].frames.size(); ++t) {
    image::Picture& picture = cine.slices[basal].frames[t];
    const image::Plane& plane = picture.plane;
    const segment::Pixel& centre = whole.borders[basal].centre;
    const double radius = 1.5 * whole.borders[basal + 1].frames[t].endo.mean();
    const float blood = picture.at(static_cast<int>(centre.x()), static_cast<int>(centre.y()));
    for (int j = 0; j < plane.rows; ++j)
      for (int i = 0; i < plane.columns; ++i) {
        const double r = std::hypot(i - centre.x(), j - centre.y()) * plane.spacing_i;
        picture.values[static_cast<std::size_t>(j) * plane.columns + i] =
            blood * (r < radius         ? 1.0F
                     : r < radius + 8.0 ? 0.35F
                                        : 0.1F);
      }
  }
  const segment::Segmentation found = segment::segment(cine, {}, "phantom");
  const std::string doubts = fmt::format("{}", fmt::join(found.doubts, "; "));
  CHECK_THAT(doubts, Catch::Contains(fmt::format("slice {} is left out: its blood", basal + 1)));
  CHECK_THAT(doubts, Catch::Contains(fmt::format("slice {} is left out at end-diast", basal + 1)));
  for (std::size_t t = 0; t < cine.slices[basal].frames.size(); ++t) {
    CHECK(found.shows[basal][t] == 0);
    CHECK(found.shows[basal + 1][t] == whole.shows[basal + 1][t]);
  }
}

TEST_CASE("a slice that begins at another time of the cycle is doubted", "[segment]") {
  image::Cine cine = five_phases().cine;
  const auto doubted = [&] {
    std::string slices;
    for (const std::string& doubt : segment::segment(cine, {}, "phantom").doubts)
      if (doubt.find("another time of the cycle") != std::string::npos)
        slices += doubt.substr(0, doubt.find(':'));
    return slices;
  };
  CHECK(doubted().empty());
  auto& frames = cine.slices[cine.slices.size() / 2].frames;
  std::rotate(frames.begin(), frames.begin() + 2, frames.end());
  CHECK(doubted() == fmt::format("slice {}", cine.slices.size() / 2 + 1));
}

TEST_CASE("what blur may hide of trabeculae is said with its volumes", "[segment]") {
  image::Cine cine = five_phases().cine;
  const auto doubt = [&] {
    const segment::Segmentation found = segment::segment(cine, {}, "phantom");
    for (const std::string& sentence : found.doubts)
      if (sentence.find("trabeculae all round") != std::string::npos)
        return std::pair(found, sentence);
    return std::pair(found, std::string());
  };
  CHECK(doubt().second.empty());
  test::blur(cine, 1.2);
  const auto [found, sentence] = doubt();
  CHECK(found.fall == 0.5);
  const auto number_behind = [&sentence = sentence](const std::string& words) {
    const std::size_t at = sentence.find(words);
    REQUIRE(at != std::string::npos);
    return std::stod(sentence.substr(at + words.size()));
  };
  // what the doubt says comes of what it advises
  segment::SegmentParameters parameters;
  parameters.fall = number_behind("segment.fall = ");
  const segment::Segmentation as_advised = segment::segment(cine, parameters, "phantom");
  const auto diastole = static_cast<std::size_t>(found.phases.end_diastole);
  const double grows = as_advised.volumes[diastole] / found.volumes[diastole] - 1.0;
  CHECK(grows > 0.1);
  CHECK(number_behind("the cavity holds ") == Approx(100.0 * grows).margin(1.0));
}

TEST_CASE("blur is not doubted where trabeculae were taken into the cavity", "[segment]") {
  phantom::Scan scan = test::noisy_scan(1);
  scan.phases = 5;
  test::KnownCine known = test::phantom_study("phantom", scan, 4.0);
  test::blur(known.cine, 0.7);
  const segment::Segmentation found = segment::segment(known.cine, {}, "phantom");
  CHECK(found.fall > 0.7);
  for (const std::string& doubt : found.doubts)
    CHECK_THAT(doubt, !Catch::Contains("trabeculae all round"));
}

TEST_CASE("volumes that rest on doubtful borders say so", "[segment]") {
  segment::Segmentation found;
  found.spacing = 8.0;
  segment::SliceBorders slice;
  slice.frames.resize(1);
  slice.frames.front().endo = segment::Radii::Constant(72, 20.0);
  slice.frames.front().endo_agrees = 1.0;
  found.borders.assign(4, slice);
  found.shows.assign(4, {1});
  found.volumes = {4.0 * 8.0 * segment::area(slice.frames.front().endo)};
  CHECK(segment::doubtful_part(found, 0) == 0.0);
  found.borders[1].frames.front().endo_agrees = 0.5;
  found.borders[3].frames.front().endo_agrees = 0.5;
  found.shows[3][0] = 0;  // does not count
  CHECK(segment::doubtful_part(found, 0) == Approx(0.25));
}

TEST_CASE("the epicardium stays within lung and within liver behind a dark line", "[segment]") {
  const segment::Radii epi = borders_beside_liver(0.5).epi;
  CHECK(epi.maxCoeff() < 35.5);
  CHECK(epi.minCoeff() > 32.5);
  CHECK(epi.mean() == Approx(34.0).margin(0.7));
}

TEST_CASE("it is the dark line that leaves liver out", "[segment]") {
  // rays within 60 degrees of the middle of the liver
  const auto liver = [](const segment::Radii& epi) {
    const Eigen::Index n = epi.size() / 6;
    return 0.5 * (epi.head(n).mean() + epi.tail(n).mean());
  };
  CHECK(liver(borders_beside_liver(0.5).epi) == Approx(34.0).margin(0.7));
  CHECK(liver(borders_beside_liver(1.0).epi) > 38.0);
}

TEST_CASE("the epicardium of a thick wall is its outer edge", "[segment]") {
  const segment::FrameBorders borders = borders_of(thick_ring());
  CHECK(borders.endo.mean() == Approx(14.0).margin(0.7));
  CHECK(borders.epi.minCoeff() > 39.0);
  CHECK(borders.epi.maxCoeff() < 41.0);
}

TEST_CASE("an epicardium that keeps its muscle beside another edge is doubted", "[segment]") {
  const image::Picture shown = ring_beside_liver(0.5, segment::CoilGradient::Zero());
  const image::Picture open = ring_beside_liver(1.0, segment::CoilGradient::Zero());
  const std::vector<segment::FrameBorders> frames = borders_in(rings(shown, open));
  CHECK(frames[0].epi_agrees > 0.95);
  INFO(frames[2].epi.maxCoeff() << " " << frames[2].epi_agrees);
  CHECK(frames[2].epi.maxCoeff() < 38.0);
  CHECK(frames[2].epi_agrees < segment::doubtful);
}

TEST_CASE("the epicardium stays within fluid that is brighter than muscle", "[segment]") {
  for (const double fluid : {0.4, 0.5, 0.7, 1.0}) {
    INFO(fluid);
    const segment::FrameBorders borders = borders_of(ring_in_fluid(fluid));
    CHECK(borders.endo.mean() == Approx(25.0).margin(0.7));
    CHECK(borders.epi.mean() == Approx(34.0).margin(1.0));
  }
}

TEST_CASE("an outflow tract is closed straight from one end of the muscle to the other",
          "[segment]") {
  const segment::Radii endo = borders_of(open_ring()).endo;
  const double straight = 25.0 * std::cos(35.0 * std::numbers::pi / 180.0);
  CHECK(endo(0) == Approx(straight).margin(1.5));  // where a circle would be at 25 mm
  CHECK(endo(endo.size() / 2) == Approx(25.0).margin(1.5));
}

TEST_CASE("coils that receive two or three times as much on one side move no border", "[segment]") {
  constexpr double within = 0.8;  // [mm]; a step of the radii is 0.75
  const segment::FrameBorders even = borders_beside_liver(0.5);
  for (const double ratio : {2.0, 3.0})  // over 100 mm
    for (const int quarter : {0, 1, 2, 3}) {
      CAPTURE(ratio, quarter);
      const double side = 0.5 * std::numbers::pi * quarter;
      const segment::FrameBorders seen = borders_beside_liver(
          0.5, std::log(ratio) / 100.0 * segment::CoilGradient(std::cos(side), std::sin(side)));
      CHECK((seen.endo - even.endo).abs().maxCoeff() < within);
      CHECK((seen.epi - even.epi).abs().maxCoeff() < within);
    }
}

TEST_CASE("a heart has the same borders however its images are stored or received, and bright",
          "[segment]") {
  std::vector<test::Variation> variations = test::other_storage();
  for (test::Variation& variation : test::other_images())
    if (variation.name == "coil of 150 mm, side 1" || variation.name.starts_with("padded") ||
        variation.name == "gamma 0.6" || variation.name == "gamma 1.6" ||
        variation.name == "offset 0.1")
      variations.push_back(std::move(variation));
  CHECK(variations.size() == 12);
  for (const test::Variation& variation : variations) {
    CAPTURE(variation.name);
    test::KnownCine changed = five_phases();
    variation.apply(changed);
    const segment::Segmentation found = segment::segment(changed.cine, {}, "phantom");
    for (const int frame : {changed.end_diastole, changed.end_systole}) {
      const Agreement endo =
          agreement(segment::contours_at(changed.cine, found, static_cast<std::size_t>(frame)),
                    changed.truth.at(frame), Side::endo);
      tell(fmt::format("{}, phase {}", variation.name, frame + 1), endo);
      CHECK(std::abs(endo.volume) < 0.03);
      CHECK(endo.dice > 0.94);
    }
  }
}

TEST_CASE("grey values that change by a millionth move no border", "[segment]") {
  image::Cine cine = five_phases().cine;
  const segment::Segmentation found = segment::segment(cine, {}, "phantom");
  phantom::Random random(3);
  for (image::CineSlice& slice : cine.slices)
    for (image::Picture& picture : slice.frames)
      for (float& value : picture.values)
        value *= static_cast<float>(1.0 + 1e-6 * random.normal());
  const segment::Segmentation again = segment::segment(cine, {}, "phantom");
  CHECK(again.shows == found.shows);
  for (std::size_t s = 0; s < found.borders.size(); ++s)
    for (std::size_t t = 0; t < found.borders[s].frames.size(); ++t) {
      CAPTURE(s, t);
      const segment::FrameBorders& before = found.borders[s].frames[t];
      const segment::FrameBorders& now = again.borders[s].frames[t];
      CHECK(segment::area(now.endo) == Approx(segment::area(before.endo)).epsilon(1e-4));
      CHECK(segment::area(now.epi) == Approx(segment::area(before.epi)).epsilon(1e-4));
    }
}

TEST_CASE("trabeculae of a phantom are taken into the cavity", "[segment]") {
  try_trabeculae(1);
}

TEST_CASE("the borders of real ventricles are those of observers", "[segment]") {
  try_patient("sunnybrook_SC-HF-I-1", "cine", 19, 8);
  try_patient("sunnybrook_SC-HF-I-4", "dicom", 20, 7);
}

TEST_CASE("a cine of too few slices or images is refused", "[segment]") {
  image::Cine cine;
  cine.slices.resize(3);
  for (image::CineSlice& slice : cine.slices) {
    slice.name = "a slice";
    slice.frames.assign(4, {});
  }
  CHECK_THROWS_WITH(segment::segment(cine, {}, "study"), Catch::Contains("4 images of"));
  cine.slices.resize(2);
  CHECK_THROWS_WITH(segment::segment(cine, {}, "study"), Catch::Contains("2 short-axis slices"));
}

TEST_CASE("images without a ring of muscle round blood are refused", "[segment]") {
  image::Cine cine;
  cine.slices.resize(4);
  for (std::size_t s = 0; s < 4; ++s) {
    image::Picture picture;
    picture.plane.columns = picture.plane.rows = 60;
    picture.plane.spacing_i = picture.plane.spacing_j = 2.0;
    picture.plane.origin.z() = 10.0 * static_cast<double>(s);
    picture.values.assign(3600, 0.0F);
    for (int k = 0; k < 3600; ++k)
      picture.values[static_cast<std::size_t>(k)] = static_cast<float>((k * 7919) % 101);
    cine.slices[s] = {fmt::format("slice {}", s + 1), {5, picture}, {}, 0.0};
  }
  CHECK_THROWS_WITH(segment::segment(cine, {}, "noise"),
                    Catch::Contains("a ring of muscle round blood; in slice") &&
                        Catch::Contains("Set segment.centre"));
  segment::SegmentParameters parameters;
  parameters.centre = {60.0, 60.0, 10.0};
  CHECK_THROWS_WITH(
      segment::segment(cine, parameters, "noise"),
      Catch::Contains("a ring of muscle round blood") && !Catch::Contains("segment.centre"));
  for (image::Picture& picture : cine.slices[2].frames)
    picture.values.assign(3600, 7.0F);
  CHECK_THROWS_WITH(segment::segment(cine, {}, "noise"),
                    Catch::Contains("the images of slice 3 show nothing: every grey value is 7"));
}

TEST_CASE("written contours are read back as contours", "[segment]") {
  const test::TemporaryFolder folder;
  Contour loop{.slice = 2, .side = Side::epi, .points = {}, .file = "", .lines = {}};
  for (int k = 0; k < 40; ++k)
    loop.points.emplace_back(30.0 * std::cos(0.157 * k), 30.0 * std::sin(0.157 * k), 5.0);
  geometry::contour_table({loop}).write_csv(folder / "loops.csv");
  const std::vector<Contour> read = geometry::read_curves(folder / "loops.csv");
  REQUIRE(read.size() == 1);
  CHECK(read.front().slice == 2);
  CHECK(read.front().side == Side::epi);
  CHECK((read.front().points.at(7) - loop.points.at(7)).norm() < 1e-3);
}
