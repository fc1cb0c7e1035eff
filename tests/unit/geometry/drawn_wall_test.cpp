#include "lv/geometry/drawn_wall.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_checks.hpp"
#include "lv/geometry/long_axis.hpp"

#include "geometry/drawn_ellipsoid.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

namespace {

using namespace drawn;
using Catch::Matchers::Contains;
using lv::InputError;
using namespace lv::geometry;

std::string notes(const DrawnWall& wall) {
  return fmt::format("{}", fmt::join(wall.notes, "|"));
}

/// Loops alone.
Drawing short_axis_alone() {
  Drawing drawing = in_scanner();
  drawing.long_axis = false;
  return drawing;
}

/// A ventricle whose apical half turns aside, as far as `radius` [mm] bends it.
Contours bent(Contours contours, const Frame& frame, double radius) {
  for (auto* set : {&contours.short_axis, &contours.apex})
    for (Contour& c : *set)
      for (Vec3& x : c.points)
        if (const double depth = -40.0 - frame.to_model(x).z(); depth > 0.0)
          x += depth * depth / (2.0 * radius) * frame.axes.col(0);
  return contours;
}

}  // namespace

TEST_CASE("a stack that ends in the middle of a ventricle hides its tip", "[unit][geometry]") {
  Drawing drawing = short_axis_alone();
  drawing.apex = false;
  drawing.slices = 6;
  CHECK_THAT(hidden_tip(draw(drawing)), Contains("slice 6 is the last towards the tip") &&
                                            Contains("give the slices down to the tip"));
  drawing.slices = 8;  // the last has a small cavity
  CHECK(hidden_tip(draw(drawing)).empty());
  drawing.slices = 6;
  drawing.long_axis = true;
  CHECK(hidden_tip(draw(drawing)).empty());
  drawing.long_axis = false;
  drawing.apex = true;
  CHECK(hidden_tip(draw(drawing)).empty());
}

TEST_CASE("an all but empty cavity in a wall of usual size is no matter of units",
          "[unit][geometry]") {
  Drawing drawing = short_axis_alone();
  drawing.shape.endo_radius = 4.0;
  const Contours contours = draw(drawing);
  CHECK_NOTHROW(check_contours(contours));
  drawing.shape.epi_radius = 4.5;
  CHECK_THROWS_AS(check_contours(draw(drawing)), InputError);
}

TEST_CASE("a base plane in an annulus too far above the slices is laid at the end of the slab",
          "[unit][geometry]") {
  const Drawing drawing = short_axis_alone();
  Contours contours = draw(drawing);
  for (const double angle : {0.0, 2.0, 4.0})
    contours.annulus.push_back(
        drawing.frame.to_image({20.0 * std::cos(angle), 20.0 * std::sin(angle), 70.0}));
  SplineFitParameters fit;
  fit.frame.base_at = BaseAt::annulus;
  const DrawnWall wall = fit_drawn_wall(contours, fit, {.base = true});
  CHECK_THAT(wall.base, Contains("where its slab ends"));
  CHECK_THAT(notes(wall), Contains("through the mitral annulus there is no wall"));
  CHECK(wall.wall.report().base_height == Approx(0.5 * drawing.spacing).margin(0.1));
  CHECK_THROWS_WITH(fit_drawn_wall(contours, fit, {}),
                    Contains("There is a wall with anatomy.contours.base_at = \"slab\""));
}

TEST_CASE("the base of a wall with long-axis curves moves with the muscle, not with the slices",
          "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.spacing = 12.0;
  drawing.slices = 6;
  Contours contours = draw(drawing);
  for (Contour& curve : contours.long_axis)  // drawn higher on one side
    std::erase_if(curve.points, [&](const lv::Vec3& x) {
      const lv::Vec3 at = drawing.frame.to_model(x);
      return at.z() > (at.x() > 0.0 ? 0.0 : -8.0);
    });
  const auto wall_without = [&](int slice) {
    std::erase_if(contours.short_axis, [&](const Contour& c) { return c.slice == slice; });
    SplineFitParameters fit;
    fit.frame.base_at = BaseAt::annulus;
    return fit_drawn_wall(contours, fit, {.base = true});
  };
  const DrawnWall more = wall_without(1);
  CHECK_THAT(more.base, Contains("as high as the long-axis curves show muscle all round"));
  CHECK((more.wall.frame().origin - drawing.frame.to_image({0.0, 0.0, -11.0})).norm() < 4.0);
  const DrawnWall fewer = wall_without(2);
  CHECK((fewer.wall.frame().origin - more.wall.frame().origin).norm() < 0.5);
  const FitReport& a = more.wall.report();
  const FitReport& b = fewer.wall.report();
  CHECK(b.volume_cavity == Approx(a.volume_cavity).epsilon(0.02));
  CHECK(b.volume_wall == Approx(a.volume_wall).epsilon(0.02));
}

TEST_CASE("slices shifted by the breath bring a proposal to align them, with its numbers",
          "[unit][geometry]") {
  const Drawing drawing = short_axis_alone();
  Contours contours = draw(drawing);
  CHECK(notes(fit_drawn_wall(contours, {}, {.base = true})).empty());
  shift_slices(contours, drawing.frame, 4.0, 7);
  const DrawnWall wall = fit_drawn_wall(contours, {}, {.base = true});
  CHECK_THAT(notes(wall), Contains("the slices seem shifted against each other") &&
                              Contains("anatomy.contours.align_slices = true moves them by up to"));
  SplineFitParameters aligned;
  aligned.align_slices = true;
  const DrawnWall moved = fit_drawn_wall(contours, aligned, {.base = true});
  CHECK(notes(moved).empty());
  double most = 0.0;
  for (const auto& image : moved.wall.report().short_axis)
    most = std::max({most, image.endo->max, image.epi->max});
  CHECK_THAT(notes(wall), Contains(fmt::format("leaves {:.1f} mm", most)));
}

TEST_CASE("slices that make no wall as they lie are moved, or refused with what moving them brings",
          "[unit][geometry]") {
  const Drawing drawing = short_axis_alone();
  Contours contours = draw(drawing);
  for (Contour& c : contours.short_axis)
    if (c.slice == 8)
      for (Vec3& x : c.points)
        x += 14.0 * drawing.frame.axes.col(0);
  CHECK_THROWS_WITH(fit_drawn_wall(contours, {}, {.base = true}),
                    Contains("slice 8") && Contains("There is a wall with "
                                                    "anatomy.contours.align_slices = true"));
  const DrawnWall wall = fit_drawn_wall(contours, {}, {.slices = true});
  REQUIRE(wall.warnings.size() == 1);
  CHECK(wall.warnings.front().part == "moved slices");
  CHECK_THAT(wall.warnings.front().text,
             Contains("the slices are moved to each other") && Contains("slice 8"));
  const auto& images = wall.wall.report().short_axis;
  CHECK(std::any_of(images.begin(), images.end(), [](const ImageReport& image) {
    return image.slice == 8 && image.shift.norm() > 8.0;
  }));
}

TEST_CASE("the long axis of a ventricle with a bent apex passes within every loop",
          "[unit][geometry]") {
  const Drawing drawing = short_axis_alone();
  for (const double radius : {60.0, 40.0}) {
    const Contours contours = bent(draw(drawing), drawing.frame, radius);
    const LongAxis axis = long_axis(contours);
    for (const Contour* loop : loops_from_base(contours, Side::endo)) {
      Vec3 middle = Vec3::Zero();
      double r = 0.0;
      for (const Vec3& x : loop->points)
        middle += x / static_cast<double>(loop->points.size());
      for (const Vec3& x : loop->points)
        r += (x - middle).norm() / static_cast<double>(loop->points.size());
      CHECK((middle - axis.point).cross(axis.up).norm() < r);
    }
    CHECK_NOTHROW(fit_drawn_wall(contours, {}, {.base = true}));
  }
}

TEST_CASE("a wall thicker than its cavity is wide is not called thin", "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.shape.base_height *= 50.0 / drawing.shape.endo_length;
  drawing.shape.endo_radius = 9.0;
  drawing.shape.endo_length = 50.0;
  drawing.shape.epi_radius = 31.0;
  drawing.shape.epi_length = 67.6;
  drawing.spacing = 8.0;
  drawing.slices = static_cast<int>((drawing.shape.base_height + 45.0) / drawing.spacing);
  drawing.noise = 0.4;
  Contours contours = draw(drawing);
  shift_slices(contours, drawing.frame, 3.0, 3);
  const FitReport report = fit_drawn_wall(contours, {}, {.base = true}).wall.report();
  CHECK(report.thinnest.value > 12.0);
  CHECK(report.thickest.value < 25.0);
}
