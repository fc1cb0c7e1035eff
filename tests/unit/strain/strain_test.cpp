#include "lv/base/check.hpp"
#include "lv/phantom/study.hpp"
#include "lv/strain/agreement.hpp"
#include "lv/strain/axial_motion.hpp"
#include "lv/strain/measures.hpp"
#include "lv/strain/reslice.hpp"
#include "lv/strain/track.hpp"

#include "support/temporary_folder.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

using namespace lv;
using namespace lv::strain;

namespace {

constexpr double pi = std::numbers::pi;

SliceWall ring(double inner, double outer) {
  return {[inner](double) { return inner; }, [outer](double) { return outer; }};
}

std::vector<Vec3> circle(double radius, const Vec3& centre) {
  std::vector<Vec3> points;
  for (int k = 0; k < 200; ++k)
    points.emplace_back(centre +
                        radius * Vec3(std::cos(pi * k / 100), std::sin(pi * k / 100), 0.0));
  return points;
}

}  // namespace

TEST_CASE("a homogeneous stretch has its strain everywhere", "[strain]") {
  const SliceMotion m = follow(ring(20, 30), [](const Vec2& X) {
    return Moved{0.8 * X, 0.8 * Mat2::Identity()};
  });
  const RingStrain s = strain_of(m.rays);
  CHECK(s.circumferential == Approx(0.5 * (0.64 - 1.0)));
  CHECK(s.radial == Approx(0.5 * (0.64 - 1.0)));
  CHECK(s.shortening == Approx(-0.2));
  CHECK(s.thickening == Approx(-0.2));
  CHECK(m.rotation == Approx(0.0).margin(1e-12));
}

TEST_CASE("a turn clockwise seen from the base is positive and no strain", "[strain]") {
  Mat2 R;
  const double turn = -0.2;  // from x towards y is anticlockwise seen from the base
  R << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
  const SliceMotion m = follow(ring(20, 30), [&](const Vec2& X) {
    return Moved{R * X + Vec2(3, 1), R};
  });
  CHECK(m.rotation == Approx(0.2));
  CHECK(strain_of(m.rays).circumferential == Approx(0.0).margin(1e-12));
}

TEST_CASE("sectors are those of the paper, counted from the septum", "[strain]") {
  SliceSeries s;
  s.slice = 4;
  s.phases = {1};
  // only the wall towards +y, the anterior wall, shortens
  s.motion.push_back(follow(ring(20, 30), [](const Vec2& X) {
    Mat2 F = Mat2::Identity();
    if (X.y() > 0.9 * X.norm())
      F *= 0.9;
    return Moved{X, F};
  }));
  for (const SegmentStrain& row : segments({s})) {
    if (row.scheme != "sector")
      continue;
    CHECK((row.segment == "ant") == (row.strain.circumferential < -0.05));
  }
}

TEST_CASE("agreement is Bland and Altman's", "[strain]") {
  const std::vector<Pair> pairs{{"sector", 1, "ant", 1.0, 2.0},
                                {"sector", 1, "inf", 2.0, 2.0},
                                {"sector", 2, "ant", 3.0, 5.0}};
  const Agreement a = agreement(pairs);
  CHECK(a.bias == Approx(1.0));
  CHECK(a.deviation == Approx(1.0));
  CHECK(a.lower == Approx(-0.96));
  CHECK(a.upper == Approx(2.96));
  CHECK(std::isnan(agreement({}).bias));
}

TEST_CASE("a table of measured strains is refused by line", "[strain]") {
  const test::TemporaryFolder folder;
  const std::string head = "slice,component,segment,frame1,frame2\n";
  const auto read = [&](const std::string& text, const std::string& column) {
    test::write_bytes(folder / "strain.csv", text);
    return read_measured(folder / "strain.csv", column, Measure::engineering);
  };
  const auto good = read(head + "1,cir,InfSept,0,-0.2\n2,rad,Ant,0,0.4\n", "frame2");
  REQUIRE(good.size() == 2);
  CHECK(good[0].segment == "infsept");
  CHECK(good[1].value == 0.4);
  CHECK_THROWS_AS(read(head + "1,cir,InfSept,0,-0.2\n", "frame3"), InputError);
  CHECK_THROWS_AS(read(head + "1,cir,Front,0,-0.2\n", "frame2"), InputError);
  CHECK_THROWS_AS(read(head + "1,long,Ant,0,-0.2\n", "frame2"), InputError);
  CHECK_THROWS_AS(read(head + "1,cir,Ant,0\n", "frame2"), InputError);
  CHECK_THROWS_WITH(read(head + "1,cir,Ant,0,nan\n", "frame2"), Catch::Contains("strain.csv:2"));
  CHECK_THROWS_WITH(read(head + "1,cir,Ant,0,-18\n", "frame2"),
                    Catch::Contains("strain.csv:2: strain \"-18\" is not a number above -1") &&
                        Catch::Contains("Strain is a fraction"));
  CHECK_THROWS_AS(strain_in("-0.6", Measure::green_lagrange, "here"), InputError);
  CHECK(strain_in("-0.6", Measure::engineering, "here") == -0.6);
}

TEST_CASE("strains of one value alone have no correlation", "[strain]") {
  const std::vector<Pair> pairs{{"sector", 1, "ant", -0.2, -0.1}, {"sector", 1, "inf", -0.2, -0.2}};
  CHECK(std::isnan(agreement(pairs).correlation));
  CHECK(agreement(pairs).bias == Approx(0.05));
}

TEST_CASE("overlap and distance of circles", "[strain]") {
  const auto a = circle(20.0, Vec3::Zero());
  CHECK(dice(a, a) == Approx(1.0));
  CHECK(dice(a, circle(10.0, Vec3::Zero())) == Approx(2.0 * 100 / 500).epsilon(0.01));
  CHECK(dice(a, circle(5.0, {40.0, 0.0, 0.0})) == 0.0);
  CHECK(distance(circle(18.0, Vec3::Zero()), {a}, true).mean == Approx(2.0).epsilon(0.01));
}

TEST_CASE("a plane cuts a box in one closed line", "[strain]") {
  std::vector<std::array<Vec3, 3>> sides;
  const std::array<Vec3, 4> corners{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 3, 0), Vec3(0, 3, 0)};
  for (int i = 0; i < 4; ++i) {
    const Vec3& a = corners[i];
    const Vec3& b = corners[(i + 1) % 4];
    const Vec3 up(0, 0, 5);
    sides.push_back({a, b, b + up});
    sides.push_back({a, b + up, a + up});
  }
  const auto lines = cut(sides, {0, 0, 2}, Vec3::UnitZ());
  REQUIRE(lines.size() == 1);
  CHECK((lines[0].front() - lines[0].back()).norm() < 1e-9);
  double length = 0.0;
  for (std::size_t i = 1; i < lines[0].size(); ++i)
    length += (lines[0][i] - lines[0][i - 1]).norm();
  CHECK(length == Approx(10.0));
}

TEST_CASE("strain and rotation of noisy phantom slices are found", "[strain]") {
  phantom::Ventricle v;
  v.shortening = 0.0;  // what moves through the planes cannot be seen in them
  const phantom::Scan scan{.phases = 12, .snr = 20.0, .shift = 3.0, .seed = 11};
  const phantom::ScanPlanes all = phantom::planes(v, scan);
  phantom::ScanPlanes some;
  some.short_axis = {all.short_axis[5], all.short_axis[8]};
  const image::Cine cine = phantom::short_axis_cine(v, scan, some);
  const geometry::Contours drawn = phantom::contours(v, scan, some, 0.0);
  const phantom::Truth truth = phantom::truth(v, scan, some);
  const geometry::Frame pose = phantom::pose(scan);
  const Orientation orientation{pose.axes.col(2), pose.to_image({30, 0, -30}), pose.origin,
                                pose.to_image({0, 0, v.cavity_apex()})};
  const auto es = static_cast<std::size_t>(truth.end_systole - 1);
  double squares = 0.0;
  for (int slice = 1; slice <= 2; ++slice) {
    SliceTask task{&cine.slices[slice - 1],
                   {},
                   0,
                   *geometry::find(drawn.short_axis, slice, geometry::Side::endo),
                   *geometry::find(drawn.short_axis, slice, geometry::Side::epi)};
    for (int k = 1; k <= scan.phases; ++k)
      task.phases.push_back(k);
    const TrackedSlice tracked = track(task, orientation, {});
    CHECK(tracked.smallest_J > 0.3);
    const auto& exact = truth.slices.at(slice - 1);
    CHECK(std::abs(tracked.series.motion[es].rotation - exact.motion[es].rotation) <
          pi / 180.0);  // one degree
    const auto found = segments({tracked.series});
    const auto true_ones = segments({exact});
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i].scheme == "sector" && found[i].phase == truth.end_systole)
        squares +=
            std::pow(found[i].strain.circumferential - true_ones[i].strain.circumferential, 2) / 12;
  }
  CHECK(std::sqrt(squares) < 0.02);
}

namespace {

/// Slices at the given heights with grey values from a function of place [mm].
std::vector<image::CineSlice> stack_of(const std::vector<double>& heights, int images,
                                       const std::function<double(const Vec3&)>& grey) {
  std::vector<image::CineSlice> stack;
  for (const double height : heights) {
    image::Picture picture;
    picture.plane.origin = {-10.0, 5.0, height};
    picture.plane.columns = 24;
    picture.plane.rows = 20;
    for (int j = 0; j < picture.plane.rows; ++j)
      for (int i = 0; i < picture.plane.columns; ++i)
        picture.values.push_back(static_cast<float>(grey(picture.plane.point(i, j))));
    stack.push_back({"slice", std::vector<image::Picture>(images, picture), {}, 0.0});
  }
  return stack;
}

}  // namespace

TEST_CASE("a cubic along the normal is followed through the slices exactly", "[strain]") {
  const auto grey = [](const Vec3& x) {
    return x.z() * x.z() * x.z() / 100.0 - x.z() + x.x() * x.z();
  };
  const auto stack = stack_of({24.0, 16.0, 8.0, 0.0, -8.0}, 3, grey);
  const auto u = [](const Vec3& X, int step) { return -1.5 * step + 0.1 * X.x(); };
  const MuscleSlice found = follow_muscle(stack, 2, 1, u);
  const image::Plane& plane = stack[2].frames[0].plane;
  for (const auto& [image, step] : {std::pair{1, 0}, {2, 1}, {0, 2}}) {
    const Vec3 X = plane.point(7, 3);
    const Vec3 x = X + (step == 0 ? 0.0 : u(X, step)) * Vec3::UnitZ();
    CHECK(found.images.frames[image].at(7, 3) == Approx(grey(x)));
  }
  CHECK(found.beyond == 0.0);
}

TEST_CASE("muscle that leaves the stack is said to and takes the end slice", "[strain]") {
  const auto stack = stack_of({8.0, 0.0}, 2, [](const Vec3& x) { return x.z(); });
  const MuscleSlice found = follow_muscle(stack, 1, 0, [](const Vec3&, int) { return -3.0; });
  CHECK(found.beyond == Approx(3.0));
  CHECK(found.images.frames[1].at(4, 4) == Approx(0.0));
}

TEST_CASE("a moved picture shows what was elsewhere", "[strain]") {
  const auto grey = [](const Vec3& x) { return std::sin(0.5 * x.x()) * std::cos(0.4 * x.y()); };
  const image::Picture picture = stack_of({0.0}, 1, grey).front().frames.front();
  const Vec3 shift(1.3, -0.6, 5.0);
  const Vec3 x = picture.plane.point(12, 10);
  CHECK(moved(picture, shift).at(12, 10) == Approx(grey(x - Vec3(1.3, -0.6, 0.0))).margin(1e-3));
}

TEST_CASE("long axes of a noisy phantom show how far the base moves", "[strain]") {
  phantom::Ventricle v;
  v.shortening = 0.14;
  const phantom::Scan scan{.field_of_view = 150, .phases = 8, .snr = 20.0, .seed = 4};
  const phantom::ScanPlanes all = phantom::planes(v, scan);
  phantom::ScanPlanes views;
  views.short_axis = {all.long_axis[0], all.long_axis[1]};
  const image::Cine cine = phantom::short_axis_cine(v, scan, views);
  const geometry::Contours drawn = phantom::contours(v, scan, all, 0.0);
  std::vector<LongAxisTask> tasks;
  for (int view = 1; view <= 2; ++view)
    tasks.push_back({&cine.slices[view - 1], 0,
                     *geometry::find(drawn.long_axis, view, geometry::Side::endo),
                     *geometry::find(drawn.long_axis, view, geometry::Side::epi)});
  const geometry::Frame pose = phantom::pose(scan);
  geometry::Frame frame = pose;
  frame.origin = pose.to_image({0, 0, v.cavity_apex()});
  const AxialMotion axial(tasks, frame, 16, {});  // twice as many steps as images
  const phantom::Motion systole(v, phantom::contraction(3.0 / 8.0));
  for (const double Z : {-5.0, -30.0, -55.0, -80.0})
    CHECK(std::abs(axial(pose.to_image({0, 0, Z}), 6) - (systole.z(Z) - Z)) < 1.5);
  CHECK(std::abs(axial(pose.to_image({0, 0, -40}), 0)) < 1e-9);
}
