#include "lv/anatomy/anatomy.hpp"
#include "lv/anatomy/drawn.hpp"
#include "lv/base/check.hpp"
#include "lv/base/table.hpp"
#include "lv/case_file/read_case.hpp"
#include "lv/geometry/contour_table.hpp"
#include "lv/geometry/landmarks.hpp"
#include "lv/geometry/long_axis.hpp"

#include "geometry/drawn_ellipsoid.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace drawn;
using Catch::Matchers::Contains;
using namespace lv;
using geometry::Landmark;

Drawing loops_alone() {
  Drawing drawing = in_scanner();
  drawing.long_axis = false;
  drawing.apex = false;
  return drawing;
}

/// A case of contours with landmarks; `more` goes under [anatomy.contours].
case_file::Case case_of(const test::TemporaryFolder& folder, const Drawing& drawing,
                        const std::vector<Landmark>& landmarks, const std::string& more = "") {
  const geometry::Contours contours = draw(drawing);
  geometry::contour_table(contours.short_axis).write_csv(folder / "loops.csv");
  geometry::write_landmarks(landmarks, folder / "landmarks.csv");
  write_file(folder / "heart.toml",
             "[anatomy]\nsource = \"contours\"\n[anatomy.contours]\nshort_axis = \"loops.csv\"\n"
             "landmarks = \"landmarks.csv\"\n" +
                 more);
  return case_file::read_case(folder / "heart.toml");
}

Landmark at(const Drawing& drawing, const char* name, const Vec3& x) {
  return {name, 1, drawing.frame.to_image(x), "", ""};
}

}  // namespace

TEST_CASE("landmarks say where septum, tips and annulus of contours are", "[anatomy]") {
  const Drawing drawing = loops_alone();
  const test::TemporaryFolder folder;
  const auto c = case_of(
      folder, drawing,
      {at(drawing, "septum_anterior", {15.0, 26.0, -10.0}),
       at(drawing, "septum_inferior", {15.0, -26.0, -10.0}),
       at(drawing, "apex_endo", {0.0, 0.0, -drawing.shape.endo_length}),
       at(drawing, "annulus_1", {20.0, 0.0, 2.0}), at(drawing, "annulus_3", {-20.0, 0.0, 4.0})});
  const anatomy::Drawn read = anatomy::read_drawn(c);
  REQUIRE(read.septum);
  const Vec3 septum = drawing.frame.to_model(Vec3(read.septum->data()));
  CHECK(std::atan2(septum.y(), septum.x()) == Approx(0.0).margin(0.02));
  CHECK(geometry::shows_apex(read.contours, Side::endo));
  CHECK_FALSE(geometry::shows_apex(read.contours, Side::epi));
  CHECK(read.contours.annulus.size() == 2);
  CHECK(read.usual_base == geometry::BaseAt::annulus);
}

TEST_CASE("the annulus of the landmarks is the height of the base plane", "[anatomy]") {
  const Drawing drawing = loops_alone();
  const test::TemporaryFolder folder;
  const std::vector<Landmark> annulus{at(drawing, "annulus_1", {20.0, 0.0, 2.0}),
                                      at(drawing, "annulus_2", {-20.0, 0.0, 4.0})};
  const auto base = [&](const std::string& more) {
    const auto shape = anatomy::make_anatomy(case_of(folder, drawing, annulus, more));
    return drawing.frame.to_model(shape.frame.origin).z();
  };
  CHECK(base("") == Approx(3.0).margin(0.3));
  CHECK(base("base_at = \"slice\"\n") == Approx(0.0).margin(0.3));
}

TEST_CASE("exchanged insertions are noted, a tip that is shown twice is refused", "[anatomy]") {
  const Drawing drawing = loops_alone();
  const test::TemporaryFolder folder;
  const auto exchanged = case_of(folder, drawing,
                                 {at(drawing, "septum_anterior", {15.0, -26.0, -10.0}),
                                  at(drawing, "septum_inferior", {15.0, 26.0, -10.0})});
  const anatomy::Drawn read = anatomy::read_drawn(exchanged);
  CHECK(std::any_of(read.notes.begin(), read.notes.end(), [](const std::string& note) {
    return note.find("seem to be exchanged") != std::string::npos;
  }));
  const Landmark tip = at(drawing, "apex_endo", {0.0, 0.0, -drawing.shape.endo_length});
  geometry::Contour point;
  point.slice = 1;
  point.points = {tip.at};
  geometry::contour_table({point}).write_csv(folder / "apex.csv");
  const auto twice = case_of(folder, drawing, {tip}, "apex_endo = \"apex.csv\"\n");
  CHECK_THROWS_WITH(anatomy::read_drawn(twice), Contains("shown by another file too"));
}

TEST_CASE("contours in other axes than LPS are warned of, with what explains them", "[anatomy]") {
  Drawing drawing = loops_alone();
  Mat3 usual;  // as hearts lie
  usual.col(2) = -Vec3(0.6, -0.6, -0.53).normalized();
  const Vec3 septum(-0.75, -0.66, 0.0);
  usual.col(0) = (septum - septum.dot(usual.col(2)) * usual.col(2)).normalized();
  usual.col(1) = usual.col(2).cross(usual.col(0));
  drawing.frame = {usual, Vec3(40.0, 10.0, -5.0)};
  const auto warnings = [&](const Vec3& signs, bool with_septum) {
    const test::TemporaryFolder folder;
    geometry::Contours contours = draw(drawing);
    for (geometry::Contour& loop : contours.short_axis)
      for (Vec3& x : loop.points)
        x = x.cwiseProduct(signs);
    geometry::contour_table(contours.short_axis).write_csv(folder / "loops.csv");
    const Vec3 point = drawing.frame.to_image({35.0, 0.0, -20.0}).cwiseProduct(signs);
    write_file(
        folder / "heart.toml",
        "[anatomy]\nsource = \"contours\"\n[anatomy.contours]\nshort_axis = \"loops.csv\"\n" +
            (with_septum ? fmt::format("septum_point = [\"{} mm\", \"{} mm\", \"{} mm\"]\n",
                                       point.x(), point.y(), point.z())
                         : ""));
    std::string all;
    for (const auto& a :
         anatomy::make_anatomy(case_file::read_case(folder / "heart.toml")).warnings)
      all += a.part == "orientation" ? a.text : "";
    return all;
  };
  CHECK(warnings({1, 1, 1}, true) == "");
  CHECK(warnings({1, 1, 1}, false) == "");
  CHECK_THAT(warnings({-1, 1, 1}, true), Contains("right for left") && Contains("must be LPS"));
  CHECK_THAT(warnings({1, -1, 1}, true), Contains("back for front"));
  CHECK_THAT(warnings({1, 1, -1}, true), Contains("head for feet"));
  CHECK_THAT(warnings({-1, -1, 1}, true), Contains("as where RAS is taken for LPS"));
  CHECK_THAT(warnings({1, 1, -1}, false), Contains("only its septum would tell"));
}
