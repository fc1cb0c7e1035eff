#include "lv/geometry/landmarks.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/geometry/drawn_wall.hpp"
#include "lv/geometry/long_axis.hpp"

#include "geometry/drawn_ellipsoid.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace drawn;
using Catch::Matchers::Contains;
using lv::InputError;
using namespace lv::geometry;

Landmark landmark(const char* name, const Vec3& at) {
  return {name, 2, at, "KL", "2026-01-31T12:00:00Z"};
}

/// A point of a ventricle at so many degrees about its axis, from x towards y.
Vec3 at_angle(const Frame& frame, double degrees, double radius, double z) {
  const double a = degrees * std::numbers::pi / 180.0;
  return frame.to_image({radius * std::cos(a), radius * std::sin(a), z});
}

std::string landmark_complaint(const std::string& text) {
  const lv::test::TemporaryFolder folder;
  lv::write_file(folder / "landmarks.csv", text);
  try {
    static_cast<void>(read_landmarks(folder / "landmarks.csv"));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

constexpr const char* landmark_header = "landmark,slice,x_mm,y_mm,z_mm,by,when\n";

}  // namespace

TEST_CASE("landmarks are read as they were written", "[unit][geometry]") {
  const lv::test::TemporaryFolder folder;
  write_landmarks({landmark("annulus_1", {1.5, -2.25, 3.0}), landmark("apex_epi", {4, 5, 6})},
                  folder / "landmarks.csv");
  const auto read = read_landmarks(folder / "landmarks.csv");
  REQUIRE(read.size() == 2);
  const Landmark* tip = find(read, "apex_epi");
  REQUIRE(tip != nullptr);
  CHECK(tip->at == Vec3(4, 5, 6));
  CHECK(tip->slice == 2);
  CHECK(tip->by == "KL");
  CHECK(find(read, "apex_endo") == nullptr);
}

TEST_CASE("a damaged table of landmarks is refused with its line", "[unit][geometry]") {
  const std::string h = landmark_header;
  CHECK_THAT(landmark_complaint("x,y\n"), Contains("no table of landmarks"));
  CHECK_THAT(landmark_complaint(h + "apex,1,0,0,0,,\n"),
             Contains("csv:2") && Contains("unknown landmark"));
  CHECK_THAT(landmark_complaint(h + "centre,1,0,0,,,\n"), Contains("z_mm \"\" is not a number"));
  CHECK_THAT(landmark_complaint(h + "centre,1,0,inf,0,,\n"),
             Contains("y_mm \"inf\" is not a number"));
  CHECK_THAT(landmark_complaint(h + "centre,1,0,0\n"), Contains("4 values instead of 7"));
  CHECK_THAT(landmark_complaint(h + "centre,1,0,0,0,,\ncentre,1,0,0,1,,\n"),
             Contains("csv:3") && Contains("there twice"));
}

TEST_CASE("the septum lies half way in angle between its insertions", "[unit][geometry]") {
  const Drawing drawing = in_scanner();
  const Contours contours = draw(drawing);
  // of unequal distance and height, so that the middle of the chord lies elsewhere
  const std::vector<Landmark> marks{
      landmark("septum_anterior", at_angle(drawing.frame, 70.0, 34.0, -10.0)),
      landmark("septum_inferior", at_angle(drawing.frame, -30.0, 26.0, -20.0))};
  const auto septum = septum_of(marks, contours, "test");
  REQUIRE(septum);
  const Vec3 x = drawing.frame.to_model(septum->middle);
  CHECK(std::atan2(x.y(), x.x()) * 180.0 / std::numbers::pi == Approx(20.0).margin(1.0));
  CHECK(x.head<2>().norm() == Approx(30.0).margin(0.5));
  CHECK(x.z() == Approx(-15.0).margin(0.5));
  CHECK_FALSE(septum->mirrored);
  const std::vector<Landmark> exchanged{landmark("septum_anterior", marks[1].at),
                                        landmark("septum_inferior", marks[0].at)};
  CHECK(septum_of(exchanged, contours, "test")->mirrored);
  CHECK_FALSE(septum_of({}, contours, "test"));
  CHECK_THROWS_WITH(septum_of({marks[0]}, contours, "test"), Contains("without the other"));
  const std::vector<Landmark> opposite{
      marks[0], landmark("septum_inferior", at_angle(drawing.frame, -110.0, 30.0, -10.0))};
  CHECK_THROWS_WITH(septum_of(opposite, contours, "test"), Contains("opposite sides"));
}
