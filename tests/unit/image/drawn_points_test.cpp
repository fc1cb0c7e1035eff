#include "lv/base/check.hpp"
#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/long_axis.hpp"
#include "lv/geometry/spline_wall.hpp"
#include "lv/image/guide_point_list.hpp"
#include "lv/image/guide_points.hpp"
#include "lv/image/sunnybrook.hpp"

#include "geometry/drawn_ellipsoid.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <sstream>

namespace {

using namespace lv;
using namespace lv::image;
using Catch::Matchers::Contains;
using geometry::Side;

/// Three slices with two images each, 10 mm apart.
DicomStack stack() {
  DicomStack s;
  for (int k = 0; k < 3; ++k) {
    DicomSlice slice;
    for (int p = 0; p < 2; ++p) {
      DicomImage image;
      image.instance = 20 * k + p + 1;
      image.plane = {Vec3(5.0, 6.0, 10.0 * k), Vec3::UnitX(), Vec3::UnitY(), 2.0, 2.0, 64, 64};
      slice.images.push_back(image);
    }
    s.slices.push_back(slice);
  }
  return s;
}

std::string circle(double radius) {
  std::string text;
  for (int i = 0; i < 24; ++i)
    text += fmt::format("{:.2f} {:.2f}\n", 30.0 + radius * std::cos(0.2618 * i),
                        30.0 + radius * std::sin(0.2618 * i));
  return text;
}

std::string complaint_of_sunnybrook(const test::TemporaryFolder& folder) {
  try {
    static_cast<void>(read_sunnybrook(folder / "", stack(), PixelOrigin::corner, DrawnBy::manual));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// Drawn contours as a list of points in any order.
std::string list(const geometry::Contours& contours) {
  std::vector<std::string> lines;
  const auto add = [&](const Vec3& x, const std::string& type, int slice) {
    lines.push_back(
        fmt::format("{:.4f}\t{:.4f}\t{:.4f}\t{}\t{}\t1\t0\n", x.x(), x.y(), x.z(), type, slice));
  };
  for (const auto& c : contours.short_axis)
    for (const Vec3& x : c.points)
      add(x, c.side == Side::endo ? "SAX_LV_ENDOCARDIAL" : "SAX_LV_EPICARDIAL", c.slice);
  for (const auto& c : contours.long_axis) {
    for (const Vec3& x : c.points)
      add(x, c.side == Side::endo ? "LAX_LV_ENDOCARDIAL" : "LAX_LV_EPICARDIAL", 100 + c.slice);
    if (c.side == Side::endo) {
      add(c.points.front(), "MITRAL_VALVE", 100 + c.slice);
      add(c.points.back(), "MITRAL_VALVE", 100 + c.slice);
    }
  }
  add(Vec3::Zero(), "LAX_RA", 1);
  std::shuffle(lines.begin(), lines.end(), std::mt19937(3));
  std::string text = "x\ty\tz\tcontour type\tslice\tweight\ttime frame\n";
  for (const std::string& line : lines)
    text += line;
  return text;
}

}  // namespace

TEST_CASE("contours in pixels go to the plane of the image whose instance number they bear",
          "[unit][image]") {
  const test::TemporaryFolder folder;
  for (const int instance : {2, 22, 42}) {
    test::write_bytes(folder / fmt::format("IM-0001-{:04d}-icontour-manual.txt", instance),
                      circle(8.0));
    test::write_bytes(folder / fmt::format("IM-0001-{:04d}-ocontour-manual.txt", instance),
                      circle(12.0));
  }
  test::write_bytes(folder / "IM-0001-0001-icontour-manual.txt", circle(6.0));
  test::write_bytes(folder / "IM-0001-0002-p1contour-manual.txt", circle(1.0));
  test::write_bytes(folder / "IM-0001-0002-icontour-auto.txt", circle(7.0));
  const DrawnPhases drawn =
      read_sunnybrook(folder / "", stack(), PixelOrigin::corner, DrawnBy::manual);
  REQUIRE(drawn.phases.size() == 2);
  CHECK(drawn.phases.at(1).short_axis.size() == 1);
  const geometry::Contours& contours = drawn.phases.at(2);
  geometry::check_contours(contours);
  const geometry::Contour* loop = geometry::find(contours.short_axis, 3, Side::endo);
  REQUIRE(loop != nullptr);
  // 38 pixels along the row from the corner: 37.5 from the centre of the first pixel
  CHECK((loop->points.front() - Vec3(5.0 + 2.0 * 37.5, 6.0 + 2.0 * 29.5, 20.0)).norm() < 1e-9);
  CHECK(drawn.notes.size() == 2);
  const DrawnPhases centred =
      read_sunnybrook(folder / "", stack(), PixelOrigin::centre, DrawnBy::manual);
  CHECK((geometry::find(centred.phases.at(2).short_axis, 3, Side::endo)->points.front() -
         loop->points.front() - Vec3(1.0, 1.0, 0.0))
            .norm() < 1e-9);
}

TEST_CASE("contours without an image, broken lines and points outside are refused",
          "[unit][image]") {
  const test::TemporaryFolder folder;
  CHECK_THAT(complaint_of_sunnybrook(folder), Contains("holds no contours drawn by hand"));
  const auto file = folder / "IM-0001-0002-icontour-manual.txt";
  test::write_bytes(file, "1 2\n3\n");
  CHECK_THAT(complaint_of_sunnybrook(folder), Contains("icontour-manual.txt:2: is no point"));
  test::write_bytes(file, "1 2\n3 nan\n");
  CHECK_THAT(complaint_of_sunnybrook(folder), Contains("icontour-manual.txt:2: is no point"));
  test::write_bytes(file, "1 2\n3 80\n");
  CHECK_THAT(complaint_of_sunnybrook(folder), Contains("lies outside the image of 64 x 64 pixels"));
  test::write_bytes(file, "\n");
  CHECK_THAT(complaint_of_sunnybrook(folder), Contains("holds no points"));
  std::filesystem::remove(file);
  test::write_bytes(folder / "IM-0001-0099-icontour-manual.txt", circle(8.0));
  CHECK_THAT(complaint_of_sunnybrook(folder),
             Contains("no image of the DICOM series has the InstanceNumber 99. Give"));
  DicomStack with_lost = stack();
  with_lost.lost = {{{"98.dcm", "it is damaged"}, 98}, {{"99.dcm", "it has no PixelSpacing"}, 99}};
  CHECK_THROWS_WITH(
      read_sunnybrook(folder / "", with_lost, PixelOrigin::corner, DrawnBy::manual),
      Contains("has the InstanceNumber 99; 99.dcm is left out: it has no PixelSpacing. Export") &&
          !Contains("98.dcm"));
}

TEST_CASE("guide points in any order become the wall that they were taken from", "[unit][image]") {
  const geometry::Contours contours = drawn::draw(drawn::in_scanner());
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "points.txt", list(contours));
  const GuidePoints read = read_guide_points(folder / "points.txt", std::nullopt, Side::epi);
  geometry::check_contours(read.contours);
  CHECK(read.contours.short_axis.size() == contours.short_axis.size());
  CHECK(read.contours.long_axis.size() == contours.long_axis.size());
  CHECK(read.contours.annulus.size() == 6);
  REQUIRE(read.notes.size() == 1);
  CHECK_THAT(read.notes.front(), Contains("1 points of other kinds are not used: LAX_RA"));
  geometry::SplineFitParameters fit;
  fit.frame.base_at = geometry::BaseAt::annulus;
  const auto wall = geometry::fit_spline_wall(read.contours, fit).report();
  const auto expected = geometry::fit_spline_wall(contours, fit).report();
  CHECK(wall.volume_cavity == Approx(expected.volume_cavity).epsilon(0.02));
  CHECK(wall.volume_wall == Approx(expected.volume_wall).epsilon(0.02));
}

TEST_CASE("subfolders of contours are read, and a border drawn twice is refused", "[unit][image]") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "i-contours");
  std::filesystem::create_directories(folder / "o-contours");
  for (const int instance : {2, 22, 42}) {
    const std::string name = fmt::format("IM-0001-{:04d}-", instance);
    test::write_bytes(folder / ("i-contours/" + name + "icontour-manual.txt"), circle(8.0));
    test::write_bytes(folder / ("o-contours/" + name + "ocontour-manual.txt"), circle(12.0));
  }
  const DrawnPhases drawn =
      read_sunnybrook(folder / "", stack(), PixelOrigin::corner, DrawnBy::manual);
  CHECK(drawn.phases.at(2).short_axis.size() == 6);
  geometry::check_contours(drawn.phases.at(2));
  test::write_bytes(folder / "IM-0002-0022-icontour-manual.txt", circle(7.0));
  CHECK_THAT(complaint_of_sunnybrook(folder),
             Contains("i-contours/IM-0001-0022-icontour-manual.txt") &&
                 Contains("draws the same border of the same image as"));
}

TEST_CASE("guide points are read under the names of columns that their writers give",
          "[unit][image]") {
  const std::string points = list(drawn::draw({}));
  const std::string rest = points.substr(points.find('\n'));
  const test::TemporaryFolder folder;
  for (const char* header : {"x\ty\tz\tcontour type\tframeID\tweight\ttime frame",
                             "x\ty\tz\tcontour type\tsliceID\tweight\ttime frame",
                             "X\tY\tZ\tContour_Type\tSlice ID\tWeight\tTimeFrame",
                             "x\ty\tz\ttype\tslice\tframeID\tframe"}) {
    test::write_bytes(folder / "points.txt", header + rest);
    const GuidePoints read = read_guide_points(folder / "points.txt", std::nullopt, Side::epi);
    CHECK(read.contours.short_axis.size() == 16);
    CHECK(read.contours.long_axis.size() == 6);
  }
}

TEST_CASE("lines given twice and a repeated closing point count once", "[unit][image]") {
  std::string points = list(drawn::draw({}));
  const test::TemporaryFolder folder;
  const auto loops = [&] {
    test::write_bytes(folder / "points.txt", points);
    return read_guide_points(folder / "points.txt", std::nullopt, Side::epi);
  };
  const GuidePoints once = loops();
  std::istringstream lines(points);
  std::string line;
  for (int i = 0; std::getline(lines, line); ++i)
    if (i > 0 && i % 5 == 0)
      points += line + "\n";
  const GuidePoints twice = loops();
  CHECK_THAT(fmt::format("{}", fmt::join(twice.notes, "|")), Contains("given twice count once"));
  geometry::check_contours(twice.contours);
  for (std::size_t i = 0; i < once.contours.short_axis.size(); ++i)
    CHECK(once.contours.short_axis[i].points.size() == twice.contours.short_axis[i].points.size());
}

TEST_CASE("an image with a count of time of its own belongs to the others", "[unit][image]") {
  std::string points = list(drawn::draw({}));
  std::string own = points;
  for (auto at = own.find("\t101\t1\t0\n"); at != std::string::npos; at = own.find("\t101\t1\t0\n"))
    own.replace(at, 9, "\t101\t1\t1.0\n");
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& text, std::optional<int> frame) {
    test::write_bytes(folder / "points.txt", text);
    return read_guide_points(folder / "points.txt", frame, Side::epi);
  };
  for (const std::optional<int> frame : {std::optional<int>(), std::optional(0)}) {
    const GuidePoints found = read(own, frame);
    CHECK(found.contours.long_axis.size() == 6);
    CHECK_THAT(fmt::format("{}", fmt::join(found.notes, "|")),
               Contains("slice 101 bears the time frame 1 where others bear 0"));
  }
  // the loops at a second time: now a time must be chosen, and the image still is of either
  std::string later = own;
  for (std::size_t at = 0, end = 0; end < points.size(); at = end) {
    end = points.find('\n', at) + 1;
    const std::string line = points.substr(at, end - at);
    if (line.find("SAX_LV") != std::string::npos)
      later += line.substr(0, line.size() - 2) + "12\n";
  }
  CHECK_THROWS_WITH(read(later, std::nullopt), Contains("has points of 2 times") &&
                                                   Contains("Choose one of the time frames 0, 12"));
  CHECK(read(later, 12).contours.long_axis.size() == 2);
  CHECK(read(later, 0).contours.long_axis.size() == 6);
}

TEST_CASE("long-axis curves end at the valves, also where they are drawn through them",
          "[unit][image]") {
  const geometry::Contours contours = drawn::draw({});
  std::string points = list(contours);
  for (const auto& c : contours.long_axis)
    for (const double t : {0.25, 0.5, 0.75}) {
      const Vec3 x = (1.0 - t) * c.points.front() + t * c.points.back() - Vec3(0.0, 0.0, 4.0);
      if (c.side == Side::endo)
        points += fmt::format("{:.4f}\t{:.4f}\t{:.4f}\tLAX_LV_ENDOCARDIAL\t{}\t1\t0\n", x.x(),
                              x.y(), x.z(), 100 + c.slice);
    }
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "points.txt", points);
  const GuidePoints read = read_guide_points(folder / "points.txt", std::nullopt, Side::epi);
  CHECK_THAT(fmt::format("{}", fmt::join(read.notes, "|")),
             Contains("9 points of long-axis curves lie in the opening of the valves"));
  for (const auto& c : read.contours.long_axis)
    CHECK(c.points.size() == 29);
}

TEST_CASE("a long-axis curve that stands in the list twice is refused", "[unit][image]") {
  const geometry::Contours contours = drawn::draw({});
  const auto with_a_second = [&](double distance) {
    std::string points = list(contours);
    for (const auto& c : contours.long_axis)
      if (c.side == Side::endo)
        for (const Vec3& inner : c.points) {
          const Vec3 x = inner - distance * Vec3(inner.x(), inner.y(), 0.0).normalized();
          points += fmt::format("{:.4f}\t{:.4f}\t{:.4f}\tLAX_LV_ENDOCARDIAL\t{}\t1\t0\n", x.x(),
                                x.y(), x.z() + 0.3 * distance, 100 + c.slice);
        }
    return points;
  };
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "points.txt", with_a_second(6.0));
  CHECK_THROWS_WITH(read_guide_points(folder / "points.txt", std::nullopt, Side::epi),
                    Contains("points.txt:") && Contains("endo is drawn twice") &&
                        Contains("Leave one of the two"));
  test::write_bytes(folder / "points.txt", with_a_second(0.5));  // a hand that went back and forth
  CHECK_NOTHROW(read_guide_points(folder / "points.txt", std::nullopt, Side::epi));
}

TEST_CASE("lists of points that say too little are refused", "[unit][image]") {
  const test::TemporaryFolder folder;
  const auto says = [&](const std::string& text) -> std::string {
    test::write_bytes(folder / "p.txt", text);
    try {
      static_cast<void>(read_guide_points(folder / "p.txt", std::nullopt, Side::epi));
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  CHECK_THAT(says(""), Contains("is empty"));
  CHECK_THAT(says("x y z\n"), Contains("column \"x\" is missing"));
  CHECK_THAT(says("x\ty\tz\ttype\tslice\n1\t2\tq\tMITRAL_VALVE\t1\n"),
             Contains("p.txt:2: \"q\" is not a finite number"));
  CHECK_THAT(says("x\ty\tz\ttype\tslice\ttime frame\n1\t2\t3\tA\t1\t0\n1\t2\t3\tA\t1\t4\n"),
             Contains("has points of 2 times") && Contains("0, 4"));
  CHECK_THAT(says("x\ty\tz\ttype\tslice\tx\n1\t2\t3\tMITRAL_VALVE\t1\t5\n"),
             Contains("p.txt:1: column \"x\" is there twice"));
  CHECK_THAT(says("x\ty\tz\ttype\tslice\n1\t2\t3\tMITRAL_VALVE\t1\t5\n"),
             Contains("p.txt:2: 6 values in a table of 5 columns"));
  CHECK_THAT(says("x\ty\tz\ttype\tslice\tweight\n1\t2\t3\tMITRAL_VALVE\t1\t0\n"),
             Contains("no point of the list has a weight above 0"));
}

TEST_CASE("guide points of weight 0 are not used", "[unit][image]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "p.txt",
                    "x\ty\tz\ttype\tslice\tweight\n1\t2\t3\tMITRAL_VALVE\t1\t1.0\n"
                    "4\t2\t3\tMITRAL_VALVE\t1\t0.0\n5\t2\t3\tMITRAL_VALVE\t1\t-1\t\n");
  std::vector<std::string> notes;
  const auto points = read_guide_point_list(folder / "p.txt", notes);
  REQUIRE(points.size() == 1);
  CHECK(points.front().x.x() == 1.0);
  CHECK(notes == std::vector<std::string>{"2 points of weight 0 or less: not used"});
}
