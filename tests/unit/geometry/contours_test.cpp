#include "lv/geometry/contours.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_checks.hpp"

#include "geometry/drawn_ellipsoid.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

namespace {

using namespace drawn;
using Catch::Matchers::Contains;
using lv::InputError;
using lv::geometry::ContourFiles;
using lv::geometry::read_contours;

constexpr const char* header = "slice,contour,point,px_x,px_y,x_mm,y_mm,z_mm\n";

std::string csv(const std::vector<Contour>& contours) {
  std::string text = header;
  for (const Contour& c : contours)
    for (std::size_t i = 0; i < c.points.size(); ++i)
      text += fmt::format("{},{},{},0,0,{:.4f},{:.4f},{:.4f}\n", c.slice, name(c.side), i + 1,
                          c.points[i].x(), c.points[i].y(), c.points[i].z());
  return text;
}

/// A file that exists as long as this.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("ventricle_contours_{}_{}.csv", getpid(), count_++)) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  static inline int count_ = 0;
  std::filesystem::path path_;
};

/// What reading a short-axis file of this text complains about; empty if it does not.
std::string complaint(const std::string& text) {
  const TemporaryFile file(text);
  try {
    static_cast<void>(read_contours({file.path(), std::nullopt, {}}));
  } catch (const InputError& error) {
    std::string message = error.what();
    const std::string path = file.path().string();
    if (const auto at = message.find(path); at != std::string::npos)
      message.replace(at, path.size(), "file");
    return message;
  }
  return {};
}

/// The complaint about drawn contours after a change.
std::string complaint_after(const std::function<void(Contours&)>& change) {
  Contours contours = draw(in_scanner());
  change(contours);
  return complaint(csv(contours.short_axis));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string drawn_csv() {
  return csv(draw(in_scanner()).short_axis);
}

Contour& loop(Contours& contours, int slice, Side side) {
  return contours.short_axis[2 * (slice - 1) + (side == Side::epi ? 1 : 0)];
}

}  // namespace

TEST_CASE("contours are read as they were written", "[unit][geometry]") {
  const Contours drawn = draw(in_scanner());
  const TemporaryFile loops(csv(drawn.short_axis));
  const TemporaryFile curves(csv(drawn.long_axis));
  const TemporaryFile apex(csv(drawn.apex));
  const Contours read = read_contours({loops.path(), curves.path(), {apex.path()}});
  REQUIRE(read.short_axis.size() == drawn.short_axis.size());
  for (std::size_t c = 0; c < drawn.short_axis.size(); ++c) {
    CHECK(read.short_axis[c].slice == drawn.short_axis[c].slice);
    CHECK(read.short_axis[c].side == drawn.short_axis[c].side);
    REQUIRE(read.short_axis[c].points.size() == drawn.short_axis[c].points.size());
    for (std::size_t i = 0; i < drawn.short_axis[c].points.size(); ++i)
      CHECK((read.short_axis[c].points[i] - drawn.short_axis[c].points[i]).norm() < 1e-3);
  }
  CHECK(read.long_axis.size() == 6);
  CHECK(read.apex.size() == 2);
  CHECK(read.short_axis[0].where(2) == loops.path().string() + ":4");
}

TEST_CASE("windows line ends, byte order marks, blank lines, spaces and column order do not matter",
          "[unit][geometry]") {
  std::istringstream lines(drawn_csv());
  std::string text = "\xEF\xBB\xBF";
  std::string line;
  while (std::getline(lines, line)) {
    // slice,contour,point,px_x,px_y,x,y,z -> z, point, contour, slice, x, y
    std::vector<std::string> f;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');)
      f.push_back(field);
    text += f[7] + " , " + f[2] + "," + f[1] + "," + f[0] + "," + f[5] + "," + f[6] + "\r\n\r\n";
  }
  CHECK(complaint(text).empty());
}

TEST_CASE("a loop may repeat its first point at its end", "[unit][geometry]") {
  Contours contours = draw(in_scanner());
  for (Contour& c : contours.short_axis)
    c.points.push_back(c.points.front());
  const TemporaryFile file(csv(contours.short_axis));
  CHECK(read_contours({file.path(), std::nullopt, {}}).short_axis[0].points.size() == 40);
}

TEST_CASE("a slice may lack its epicardium", "[unit][geometry]") {
  CHECK(complaint_after([](Contours& c) { c.short_axis.erase(c.short_axis.begin() + 5); }).empty());
}

TEST_CASE("a contour file that is not there is named", "[unit][geometry]") {
  CHECK_THROWS_WITH(read_contours({"no/such/contours.csv", std::nullopt, {}}),
                    Contains("no/such/contours.csv") && Contains("cannot be opened"));
}

TEST_CASE("a bad table is refused by line, value, rule and remedy", "[unit][geometry]") {
  const std::string good = drawn_csv();
  CHECK_THAT(complaint(""), Contains("file: the contour file is empty"));
  CHECK_THAT(complaint(header), Contains("holds no points"));
  CHECK_THAT(complaint(replaced(good, ",x_mm", "")),
             Contains("file:1: column \"x_mm\" is missing") && Contains("slice,contour,point"));
  CHECK_THAT(complaint(replaced(good, "x_mm", "x_cm")),
             Contains("file:1: unknown column \"x_cm\""));
  CHECK_THAT(complaint(replaced(good, "px_y", "px_x")),
             Contains("file:1: column \"px_x\" appears twice"));
  CHECK_THAT(complaint(replaced(good, "\n1,endo,1,0,0,", "\n1,endo,1,0,0,abc")),
             Contains("file:2: x_mm \"abc") && Contains("is not a finite number"));
  CHECK_THAT(
      complaint(replaced(good, "\n1,endo,2,0,0,", "\n1,endo,2,0,0,nan,0,0\n1,endo,3,0,0,")),
      Contains("file:3: x_mm \"nan\" is not a finite number") && Contains("remove the line"));
  CHECK_THAT(complaint(replaced(good, "\n1,endo,2,", "\n1.5,endo,2,")),
             Contains("file:3: slice \"1.5\" is not a whole number"));
  CHECK_THAT(complaint(replaced(good, "\n1,endo,2,", "\n1,inner,2,")),
             Contains("file:3: unknown contour \"inner\"") && Contains("endo (inner border"));
  CHECK_THAT(complaint(replaced(good, "\n1,endo,2,", "\n7,1,endo,2,")),
             Contains("file:3: 9 values in a table of 8 columns"));
  CHECK_THAT(complaint(replaced(good, "\n1,endo,2,", "\n1,endo,1,")),
             Contains("file:3: slice 1, endo, point 1 is given a second time (first in line 2)"));
}

TEST_CASE("contours may say how they were drawn, in known words", "[unit][geometry]") {
  const std::string good = csv(draw(in_scanner()).short_axis);
  const auto with = [&](const char* how) {
    std::string text;
    std::istringstream lines(good);
    for (std::string line; std::getline(lines, line);)
      text += line + (text.empty() ? ",how,by" : fmt::format(",{},KL", how)) + "\n";
    return text;
  };
  const TemporaryFile file(with("corrected"));
  const Contours read = read_contours({file.path(), std::nullopt, {}});
  CHECK(read.short_axis.at(0).drawn.how == "corrected");
  CHECK(read.short_axis.at(0).drawn.by == "KL");
  CHECK(read.short_axis.at(0).drawn.when.empty());
  CHECK_THAT(complaint(with("guessed")), Contains("unknown way to draw \"guessed\""));
}

TEST_CASE("too few points or slices are refused", "[unit][geometry]") {
  CHECK_THAT(complaint_after([](Contours& c) { loop(c, 2, Side::endo).points.resize(7); }),
             Contains("file:82: slice 2, endo: 7 points in a short-axis loop; at least 8"));
  CHECK_THAT(complaint_after([](Contours& c) { c.short_axis.resize(4); }),
             Contains("2 short-axis slices; at least 3"));
}

TEST_CASE("a slice without endocardium is refused", "[unit][geometry]") {
  CHECK_THAT(complaint_after([](Contours& c) { c.short_axis.erase(c.short_axis.begin() + 4); }),
             Contains("slice 3 has no endocardium"));
}

TEST_CASE("other units than millimetres are refused and guessed", "[unit][geometry]") {
  const auto scaled = [](double factor) {
    return complaint_after([factor](Contours& contours) {
      for (Contour& c : contours.short_axis)
        for (Vec3& x : c.points)
          x *= factor;
    });
  };
  CHECK_THAT(scaled(0.1), Contains("the mean diameter of the endocardium is 3.") &&
                              Contains("between 10 and 120 mm") && Contains("seem to be in cm"));
  CHECK_THAT(scaled(0.001), Contains("seem to be in m:"));
  CHECK_THAT(scaled(1e3), Contains("seem to be in micrometres"));
  CHECK_THAT(scaled(1e6), Contains("No common unit explains it"));
}

TEST_CASE("a point out of its slice's plane is refused", "[unit][geometry]") {
  CHECK_THAT(
      complaint_after([](Contours& c) {
        loop(c, 1, Side::endo).points[4] += oblique_frame().axes.col(2) * 2.0;
      }),
      Contains("file:6: slice 1, endo: the point (") && Contains("out of the slice's plane"));
}

TEST_CASE("the one point that is far off is named, not those that it tilts the plane from",
          "[unit][geometry]") {
  CHECK_THAT(
      complaint_after([](Contours& c) { loop(c, 1, Side::endo).points[30].x() += 120.0; }),
      Contains("file:32: slice 1, endo: the point (") && Contains("out of the slice's plane"));
}

TEST_CASE("a slice that is missing and one that is misplaced are told apart", "[unit][geometry]") {
  using lv::geometry::notes_on_spacing;
  const Contours drawn_well = draw(in_scanner());
  CHECK(notes_on_spacing(drawn_well).empty());
  Contours missing = drawn_well;
  std::erase_if(missing.short_axis, [](const Contour& c) { return c.slice == 3; });
  REQUIRE(notes_on_spacing(missing).size() == 1);
  CHECK_THAT(notes_on_spacing(missing).front(),
             Contains("slices 2 and 4 lie 20.0 mm apart, others 10.0 mm"));
  Contours misplaced = drawn_well;
  for (Contour& c : misplaced.short_axis)
    if (c.slice == 4)
      for (Vec3& x : c.points)
        x += 6.5 * oblique_frame().axes.col(2);
  REQUIRE(notes_on_spacing(misplaced).size() == 1);
  CHECK_THAT(notes_on_spacing(misplaced).front(),
             Contains("slice 4 lies ") && Contains("it seems misplaced"));
}

TEST_CASE("an open loop is refused with its gap", "[unit][geometry]") {
  CHECK_THAT(complaint_after([](Contours& c) { loop(c, 1, Side::endo).points.resize(33); }),
             Contains("file:34: slice 1, endo: the loop is open") &&
                 Contains("mm apart where neighbouring points are 2.9 mm apart"));
}

TEST_CASE("what is wrong with single slices is told of all, and nothing of good ones",
          "[unit][geometry]") {
  using lv::geometry::slice_faults;
  Contours wrong = draw(in_scanner());
  CHECK(slice_faults(wrong.short_axis).empty());
  auto& points = loop(wrong, 3, Side::epi).points;
  std::swap(points[10], points[13]);
  for (Contour& c : wrong.short_axis)
    if (c.slice == 2)
      c.side = c.side == Side::endo ? Side::epi : Side::endo;
  for (Vec3& x : loop(wrong, 4, Side::endo).points)
    x += 300.0 * oblique_frame().axes.col(0);
  for (Vec3& x : loop(wrong, 5, Side::endo).points)
    x += 20.0 * oblique_frame().axes.col(0);
  std::vector<std::string> told;
  for (const auto& fault : slice_faults(wrong.short_axis))
    told.push_back(fmt::format("{}: {}", fault.slice, fault.what));
  std::sort(told.begin(), told.end());
  CHECK(told == std::vector<std::string>{
                    "2: the endocardium encloses the epicardium, as if they were exchanged",
                    "3: the epicardium crosses itself",
                    "4: the endocardium lies beside the epicardium",
                    "5: the endocardium crosses the epicardium"});
}

TEST_CASE("a loop that crosses itself is refused with the place", "[unit][geometry]") {
  CHECK_THAT(complaint_after([](Contours& c) {
               auto& points = loop(c, 3, Side::endo).points;
               std::swap(points[10], points[13]);
             }),
             // points 10 and 11 are now joined by the chord that the one from 14 to 15 cuts
             Contains("slice 3, endo: the loop crosses itself at (") &&
                 Contains("after its points 10 and 14"));
}

TEST_CASE("loops of which a part was not drawn are told", "[unit][geometry]") {
  using lv::geometry::notes_on_gaps;
  Contours contours = draw(in_scanner());
  CHECK(notes_on_gaps(contours).empty());
  auto& points = loop(contours, 3, Side::epi).points;
  const auto count = static_cast<std::ptrdiff_t>(points.size());
  points.erase(points.begin() + count / 4, points.begin() + 3 * count / 4);
  REQUIRE(notes_on_gaps(contours).size() == 1);
  CHECK_THAT(notes_on_gaps(contours).front(),
             Contains("slice 3 epi (") && Contains("without points"));
}

TEST_CASE("an endocardium that crosses its epicardium is refused with the place",
          "[unit][geometry]") {
  CHECK_THAT(complaint_after([](Contours& c) {
               for (Vec3& x : loop(c, 2, Side::endo).points)
                 x += oblique_frame().axes.col(0) * 14.0;
             }),
             Contains("slice 2: the endocardium crosses the epicardium (") && Contains(") at ("));
}

TEST_CASE("swapped and separate borders are refused", "[unit][geometry]") {
  CHECK_THAT(complaint_after([](Contours& c) {
               std::swap(loop(c, 2, Side::endo).points, loop(c, 2, Side::epi).points);
             }),
             Contains("slice 2: the endo loop encloses the epi loop") && Contains("seem swapped"));
  CHECK_THAT(complaint_after([](Contours& c) {
               for (Vec3& x : loop(c, 2, Side::endo).points)
                 x += oblique_frame().axes.col(0) * 90.0;
             }),
             Contains("slice 2: the endo loop lies beside the epi loop"));
  CHECK_THAT(complaint_after([](Contours& c) {
               std::swap(loop(c, 2, Side::epi).points, loop(c, 4, Side::epi).points);
             }),
             Contains("slice 2, epi") && Contains("Both borders of a slice lie on one image"));
}

TEST_CASE("slices that are not parallel are refused", "[unit][geometry]") {
  CHECK_THAT(complaint_after([](Contours& c) {
               const Frame frame = oblique_frame();
               const Mat3 turn =
                   Eigen::AngleAxisd(0.6, frame.axes.col(0).eval()).toRotationMatrix();
               const Vec3 centre = frame.to_image({0.0, 0.0, -30.0});
               for (const Side side : {Side::endo, Side::epi})
                 for (Vec3& x : loop(c, 4, side).points)
                   x = centre + turn * (x - centre);
             }),
             Contains("slice 4 is tilted by") && Contains("at most 15 are accepted"));
}

TEST_CASE("slices out of order, in one plane or crossing are refused", "[unit][geometry]") {
  const auto moved = [](int slice, double distance) {
    return complaint_after([=](Contours& c) {
      for (const Side side : {Side::endo, Side::epi})
        for (Vec3& x : loop(c, slice, side).points)
          x += oblique_frame().axes.col(2) * distance;
    });
  };
  CHECK_THAT(moved(4, 25.0), Contains("slice 4 does not follow slices 2 and 3: it lies 15.0 mm "
                                      "back"));
  CHECK_THAT(moved(4, 9.8), Contains("slices 3 and 4 lie in the same plane (0.20 mm apart)"));
  CHECK_THAT(complaint_after([](Contours& c) {
               const Frame frame = oblique_frame();
               const Mat3 turn =
                   Eigen::AngleAxisd(0.24, frame.axes.col(0).eval()).toRotationMatrix();
               const Vec3 centre = frame.to_image({0.0, 0.0, -14.0});
               for (const Side side : {Side::endo, Side::epi})
                 for (Vec3& x : loop(c, 3, side).points)
                   x = centre + turn * (x - frame.to_image({0.0, 0.0, -20.0}));
             }),
             Contains("slices 2 and 3 cross each other at ("));
}

TEST_CASE("long-axis and apex points far from the slices are refused", "[unit][geometry]") {
  Contours contours = draw(in_scanner());
  contours.apex[1].points[0] *= 10.0;
  CHECK_THROWS_WITH(
      lv::geometry::check_contours(contours),
      Contains("slice 1, epi: the point (") && Contains("mm from the short-axis slices"));
}

TEST_CASE("long-axis curves in other axes than the slices are refused with the distance",
          "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.frame.origin = {45.0, -45.0, -20.0};
  CHECK_NOTHROW(lv::geometry::check_contours(draw(drawing)));
  for (const Vec3& signs : {Vec3(-1, -1, 1), Vec3(-1, 1, 1)}) {
    Contours contours = draw(drawing);
    for (Contour& curve : contours.long_axis)
      for (Vec3& x : curve.points)
        x = x.cwiseProduct(signs);
    CHECK_THROWS_WITH(lv::geometry::check_contours(contours),
                      Contains("the long-axis curve passes the short-axis loops") &&
                          Contains("at most 20 mm are accepted") && Contains("turned (RAS)"));
  }
  Contours far_below = draw(drawing);
  for (Vec3& x : far_below.long_axis[2].points)
    x -= 120.0 * drawing.frame.axes.col(2);
  CHECK_THROWS_WITH(lv::geometry::check_contours(far_below),
                    Contains("slice 2, endo: the long-axis curve passes the short-axis loops"));
}
