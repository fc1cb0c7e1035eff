#include "lv/heartbeat/base_motion.hpp"

#include "lv/base/check.hpp"
#include "lv/base/units.hpp"

#include "support/scanner_files.hpp"
#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
using heartbeat::BaseMotion;
using heartbeat::MeasuredMotion;
using units::degree;

constexpr const char* header = "time_s,axial_mm,septal_tilt_deg,anterior_tilt_deg,rotation_deg\n";
constexpr double period = 0.8;

MeasuredMotion read(const std::string& text) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "motion.csv", text);
  return heartbeat::read_motion({(folder / "motion.csv").string(), period});
}

std::string table(const std::string& lines) {
  return header + lines;
}

/// Down in systole, back in two strides.
const char* whole = "0,0,0,0,0\n0.1,5,1,0,1\n0.3,14,2,-1,-3\n0.45,8,1,0,-1\n0.6,3,0,0,0\n";

BaseMotion motion(double onset = 0.0, double zero = 0.0) {
  return {read(table(whole)), {}, {period, onset, zero}};
}

double axial(const BaseMotion& motion, double since) {
  return -motion.at(since).at(Vec3::Zero()).z();
}

}  // namespace

TEST_CASE("a base's motion is read in any order of its columns", "[unit][heartbeat]") {
  const MeasuredMotion m = read(
      "# a "
      "comment\nrotation_deg,cycle_share,Axial_mm,anterior_tilt_deg,septal_tilt_deg\n0,0,0,0,0\n"
      "-3,0.25,14,2,1\n# another\n1,0.5,7,0,0\n0,0.75,1,0,0\n0,1,0,0,0\n");
  REQUIRE(m.times.size() == 4);  // the last repeats the first
  CHECK(m.times[1] == Approx(0.25 * period));
  CHECK(m.poses[1].axial == 14.0);
  CHECK(m.poses[1].septal_tilt == Approx(1.0 * degree));
  CHECK(m.poses[1].anterior_tilt == Approx(2.0 * degree));
  CHECK(m.poses[1].rotation == Approx(-3.0 * degree));
}

TEST_CASE("a wrong table of the base's motion is refused with its line", "[unit][heartbeat]") {
  const std::vector<std::array<std::string, 2>> wrong{
      {"", "is empty"},
      {"axial_mm,septal_tilt_deg,anterior_tilt_deg,rotation_deg\n0,0,0,0\n", "csv:1: has neither"},
      {"time_s,cycle_share,axial_mm,septal_tilt_deg,anterior_tilt_deg,rotation_deg\n",
       "csv:1: has both"},
      {"time_s,axial_mm,septal_tilt_deg,anterior_tilt_deg\n0,0,0,0\n",
       "csv:1: the column rotation_deg is missing"},
      {"time_s,axial_mm,septal_tilt_deg,anterior_tilt_deg,rotation_deg,tilt\n",
       "csv:1: the column tilt is none of them"},
      {"time_s,axial_mm,axial_mm,septal_tilt_deg,anterior_tilt_deg,rotation_deg\n",
       "csv:1: the column axial_mm is there twice"},
      {table("0,0,0,0,0\n0.2,1,0,0,0\n"), "csv:3: the motion has 2 lines"},
      {table("0,0,0,0,0\n0.2,1,0,0\n"), "csv:3: has 4 values instead of 5"},
      {table("0,0,0,0,0\n0.2,nan,0,0,0\n"), "csv:3: axial_mm \"nan\" is no number"},
      {table("0,0,0,0,0\n0.2,1,,0,0\n"), "csv:3: septal_tilt_deg \"\" is no number"},
      {table("0.1,0,0,0,0\n"), "csv:2: the first time is 0.1 s"},
      {table("0,0,0,0,0\n0.2,1,0,0,0\n0.2,1,0,0,0\n"), "csv:4: 0.2 s is not after"},
      {table("0,0,0,0,0\n200,1,0,0,0\n"), "csv:3: 200 s is beyond the end of a beat"},
      {table("0,0,0,0,0\n0.2,5,0,0,0\n0.4,9,0,0,0\n0.8,4,0,0,0\n"),
       "csv:5: the table does not close: at the end of the beat axial_mm is 4"},
      {table("0,0,0,0,0\n0.1,5,0,0,0\n0.2,9,0,0,0\n0.4,2,0,0,0\n"),
       "csv:5: the table does not close: it ends at 0.4 s"},
      {table("0,0,0,0,0\n0.2,12,0,0,0\n0.4,140,0,0,0\n0.7,0,0,0,0\n"),
       "csv:4: axial_mm moves by 140 mm in a beat"},
      {table("0,0,0,0,0\n0.2,1,11,0,0\n0.4,1,-11,0,0\n0.7,0,0,0,0\n"),
       "csv:3: septal_tilt_deg moves by 22 deg"},
      {table("0,0,0,0,0\n0.2,1,0,0,31\n0.4,1,0,0,0\n0.7,0,0,0,0\n"),
       "csv:3: rotation_deg moves by 31 deg"},
      {table("0,0,0,0,0\n0.01,9,0,0,0\n0.4,5,0,0,0\n0.7,0,0,0,0\n"),
       "csv:2: axial_mm moves at 900 mm/s to the next line"},
      {table("0,0,0,0,0\n0.2,9,0,0,0\n0.4,5,0,0,0\n0.79,8,0,0,0\n"),
       "csv:5: axial_mm moves at 800 mm/s to the first line of the next beat"}};
  for (const auto& [text, message] : wrong)
    CHECK_THROWS_WITH(read(text), Contains(message));
  CHECK_THROWS_WITH(heartbeat::read_motion({"/nowhere/motion.csv", period}),
                    Contains("cannot be read"));
}

TEST_CASE("a base moves through its lines, beat by beat, and not beyond them",
          "[unit][heartbeat]") {
  const BaseMotion m = motion();
  CHECK(axial(m, 0.0) == 0.0);
  CHECK(axial(m, 0.1) == Approx(5.0));
  CHECK(axial(m, 0.3) == Approx(14.0));
  CHECK(axial(m, 0.6) == Approx(3.0));
  CHECK(axial(m, period) == Approx(0.0).margin(1e-12));
  CHECK(axial(m, 0.45 + 3.0 * period) == Approx(8.0));
  constexpr double h = 1e-4;
  double before = axial(m, -h);
  double slope_before = (axial(m, -h) - axial(m, -2.0 * h)) / h;
  for (double t = 0.0; t < period; t += h) {
    const double now = axial(m, t);
    CHECK((now > -1e-12 && now < 14.0 + 1e-12));
    const double slope = (now - before) / h;
    CHECK(std::abs(slope - slope_before) < 1.5);  // of up to 80 mm/s: no kinks
    before = now;
    slope_before = slope;
  }
}

TEST_CASE("a base's motion begins with calcium, and from the shape that was seen",
          "[unit][heartbeat]") {
  CHECK(axial(motion(0.1), 0.1) == Approx(0.0).margin(1e-12));
  CHECK(axial(motion(0.1), 0.4) == Approx(14.0));
  const BaseMotion from_systole = motion(0.0, 0.3);
  CHECK(from_systole.at(0.3).at({1.0, 2.0, 3.0}).norm() < 1e-12);
  CHECK(axial(from_systole, 0.0) == Approx(-14.0));
  CHECK(BaseMotion().at(0.3).at({1.0, 2.0, 3.0}).norm() == 0.0);
}
