#include "lv/anatomy/segmentation.hpp"

#include "lv/base/table.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

using namespace lv;

namespace {

/// Three slices of five phases without a ventricle, and a long axis in the plane y = 2 with its
/// ends.
anatomy::CineSegmentation with_long_axis() {
  anatomy::CineSegmentation s;
  s.cine.slices.resize(3);
  image::CineSlice view;
  image::Picture picture;
  picture.plane.origin = {-40.0, 2.0, -80.0};
  picture.plane.along_column = Vec3::UnitZ();
  picture.plane.columns = picture.plane.rows = 90;
  picture.values.assign(8100, 1.0F);
  view.frames.assign(5, picture);
  s.long_axis = {view, view};
  s.found.volumes.assign(5, 0.0);
  segment::LongAxisMarks marks;
  marks.annulus = {segment::FoundPoint{{-20.0, 2.0, 1.0}, 0.9},
                   segment::FoundPoint{{20.0, 2.0, -1.0}, 0.8}};
  marks.apex = segment::FoundPoint{{0.0, 2.0, -70.0}, 0.7};
  segment::LongAxisMarks other;
  other.apex = segment::FoundPoint{{1.0, 4.0, -71.0}, 0.65};
  other.annulus[0] = segment::FoundPoint{{-18.0, 2.0, 2.0}, 0.3};
  s.ends.views = {std::vector<segment::LongAxisMarks>(5, marks),
                  std::vector<segment::LongAxisMarks>(5, other)};
  return s;
}

}  // namespace

TEST_CASE("ends of long axes are proposed as landmarks on their images", "[anatomy]") {
  const auto landmarks = anatomy::proposed_landmarks(with_long_axis(), 2);
  REQUIRE(landmarks.size() == 3);  // the doubtful point is none
  const geometry::Landmark* tip = geometry::find(landmarks, "apex_endo");
  REQUIRE(tip != nullptr);
  CHECK(tip->slice == 4);  // the first after three slices
  CHECK(tip->by == "proposed");
  CHECK(tip->at.isApprox(Vec3(0.5, 2.0, -70.5)));  // the mean of both, on that image
  REQUIRE(geometry::find(landmarks, "annulus_2") != nullptr);
  CHECK(geometry::find(landmarks, "annulus_2")->at.isApprox(Vec3(20.0, 2.0, -1.0)));
}

TEST_CASE("a segmentation keeps the ends of its long axes with their confidence", "[anatomy]") {
  const test::TemporaryFolder folder;
  anatomy::write_segmentation(with_long_axis(), folder / "heart.segment");
  const auto kept = geometry::read_landmarks(anatomy::landmarks_file(folder / "heart.segment", 4));
  CHECK(kept.size() == 3);
  const Table ends = Table::read_csv(folder / "heart.segment/long_axis.csv");
  CHECK(ends.rows().size() == 25);
  const auto doubtful = ends.words("doubtful");
  CHECK(std::count(doubtful.begin(), doubtful.end(), "yes") == 5);
}

TEST_CASE("a kept segmentation is whole, though one before it was cut off", "[anatomy]") {
  const test::TemporaryFolder folder;
  const auto unfinished = folder / "heart.segment.part";
  std::filesystem::create_directories(unfinished / "contours");
  std::ofstream(unfinished / "contours/phase_99.csv") << "left by a run that was killed\n";
  anatomy::keep_segmentation(with_long_axis(), folder / "heart.segment/");
  CHECK(std::filesystem::exists(folder / "heart.segment/segmentation.txt"));
  CHECK_FALSE(std::filesystem::exists(folder / "heart.segment/contours/phase_99.csv"));
  CHECK_FALSE(std::filesystem::exists(unfinished));
}
