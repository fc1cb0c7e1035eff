#include "lv/geometry/spline_wall.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/long_axis.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include "geometry/drawn_ellipsoid.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace drawn;
using Catch::Matchers::Contains;
using lv::InputError;
using lv::geometry::BasePlane;
using lv::geometry::fit_spline_wall;
using lv::geometry::SplineFitParameters;
using lv::geometry::SplineWall;

/// The farthest distance of the fitted wall's two surfaces from the drawn ellipsoids [mm].
double farthest(const SplineWall& wall, const Drawing& drawing) {
  double most = 0.0;
  for (const Side side : {Side::endo, Side::epi})
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j < 36; ++j) {
        const Vec3 x = wall.point(i / 20.0, 2.0 * pi * j / 36, side == Side::endo ? 0.0 : 1.0);
        const Vec3 drawn = drawing.frame.to_model(wall.frame().to_image(x));
        most = std::max(most, std::abs(distance(drawing.shape, side, drawn)));
      }
  return most;
}

void check_volumes(const SplineWall& wall, const Ellipsoid& shape, double tolerance) {
  const double cavity = shape.enclosed_volume(0.0);
  const double muscle = shape.enclosed_volume(1.0) - cavity;
  CHECK(wall.report().volume_cavity == Approx(cavity).epsilon(tolerance));
  CHECK(wall.report().volume_wall == Approx(muscle).epsilon(tolerance));
}

/// Angle between two directions [radians].
double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

bool notes_contain(const SplineWall& wall, const std::string& text) {
  const auto& notes = wall.report().notes;
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

/// Jacobian determinants at the corners of all elements are positive.
bool untangled(const lv::mesh::Mesh& mesh) {
  constexpr int next[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                              {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int k = 0; k < 8; ++k) {
      const auto cell = mesh.cell(c);
      const auto edge = [&](int i) -> Vec3 {
        return mesh.nodes[cell[next[k][i]]] - mesh.nodes[cell[k]];
      };
      if (edge(0).cross(edge(1)).dot(edge(2)) <= 0.0)
        return false;
    }
  return true;
}

}  // namespace

TEST_CASE("contours of an ellipsoid give the ellipsoid", "[unit][geometry]") {
  Drawing drawing;
  SECTION("aligned with the scanner") {}
  SECTION("oblique") {
    drawing = in_scanner();
  }
  SECTION("without long axes") {
    drawing = in_scanner();
    drawing.long_axis = false;
  }
  const SplineWall wall = fit_spline_wall(draw(drawing), {});
  check_volumes(wall, drawing.shape, 0.01);
  CHECK(farthest(wall, drawing) < 0.2);
  CHECK(angle(wall.frame().axes.col(2), drawing.frame.axes.col(2)) < 1e-6);
  CHECK((wall.frame().origin - drawing.frame.origin).norm() < 1e-6);
  for (const auto& slice : wall.report().short_axis) {
    CHECK(slice.endo->max < 0.2);
    CHECK(slice.epi->max < 0.2);
  }
}

TEST_CASE("noise and thick slices do not bias the volumes", "[unit][geometry]") {
  const double spacing = GENERATE(8.0, 10.0);
  Drawing drawing = in_scanner();
  drawing.spacing = spacing;
  drawing.slices = spacing > 9.0 ? 8 : 10;
  drawing.noise = 0.7;
  const double cavity = drawing.shape.enclosed_volume(0.0);
  const double muscle = drawing.shape.enclosed_volume(1.0) - cavity;
  constexpr int observers = 8;
  double cavity_bias = 0.0;
  double muscle_bias = 0.0;
  for (int i = 0; i < observers; ++i) {
    drawing.seed = i + 1;
    const auto report = fit_spline_wall(draw(drawing), {}).report();
    cavity_bias += (report.volume_cavity / cavity - 1.0) / observers;
    muscle_bias += (report.volume_wall / muscle - 1.0) / observers;
  }
  CHECK(std::abs(cavity_bias) < 0.005);
  CHECK(std::abs(muscle_bias) < 0.005);
}

TEST_CASE("long axes that contradict consistent slices hardly count", "[unit][geometry]") {
  const Drawing drawing = in_scanner();
  Contours contours = draw(drawing);
  for (Contour& c : contours.long_axis)
    for (Vec3& x : c.points)
      if (c.side == Side::endo) {
        const Vec3 from_axis = drawing.frame.to_model(x).cwiseProduct(Vec3(1.0, 1.0, 0.0));
        x += drawing.frame.axes * from_axis.normalized() * 2.0;  // 20 per cent of the volume
      }
  const SplineWall wall = fit_spline_wall(contours, {});
  check_volumes(wall, drawing.shape, 0.03);
  for (const auto& slice : wall.report().short_axis)
    CHECK(slice.endo->rms < 0.3);
}

TEST_CASE("slices tilted against the long axis give the ellipsoid", "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.tilt = 8.0 * pi / 180.0;
  const SplineWall wall = fit_spline_wall(draw(drawing), {});
  check_volumes(wall, drawing.shape, 0.01);
  CHECK(farthest(wall, drawing) < 0.2);
  CHECK(angle(wall.frame().axes.col(2), drawing.frame.axes.col(2)) < 0.02);
  CHECK(wall.report().slice_tilt == Approx(drawing.tilt).margin(0.02));
  CHECK(notes_contain(wall, "endo is extrapolated by up to"));
}

TEST_CASE("slices shifted between breath-holds are put back by the long axes", "[unit][geometry]") {
  const Drawing drawing = in_scanner();
  Contours contours = draw(drawing);
  const auto shifts = shift_slices(contours, drawing.frame, 3.0, 7);
  const SplineWall wall = fit_spline_wall(contours, {});
  for (std::size_t k = 0; k < shifts.size(); ++k)
    CHECK((wall.report().short_axis[k].shift + shifts[k]).norm() < 1.0);
  check_volumes(wall, drawing.shape, 0.01);

  SplineFitParameters as_drawn;
  as_drawn.correct_shifts = false;
  const SplineWall uncorrected = fit_spline_wall(contours, as_drawn);
  CHECK(uncorrected.report().short_axis[0].shift.norm() == 0.0);
  CHECK(uncorrected.report().short_axis[0].endo->max > 2.0 * wall.report().short_axis[0].endo->max);
}

TEST_CASE("without long axes slices are moved to where the wall is smooth, if that is asked for",
          "[unit][geometry]") {
  Drawing drawing;
  drawing.long_axis = false;
  Contours contours = draw(drawing);
  const auto shifts = shift_slices(contours, drawing.frame, 3.0, 7);
  const auto rms = [](const SplineWall& wall) {
    double sum = 0.0;
    for (const auto& image : wall.report().short_axis)
      sum += image.endo->rms * image.endo->rms;
    return std::sqrt(sum);
  };
  const SplineWall as_drawn = fit_spline_wall(contours, {});
  CHECK(as_drawn.report().short_axis[3].shift.norm() == 0.0);
  SplineFitParameters parameters;
  parameters.align_slices = true;
  const SplineWall aligned = fit_spline_wall(contours, parameters);
  CHECK(rms(aligned) < 0.5 * rms(as_drawn));
}

TEST_CASE(
    "where slices may move, a tip without a cavity that lies beside the long axis is left out",
    "[unit][geometry]") {
  Drawing drawing;
  drawing.long_axis = false;
  drawing.apex = false;
  Contours contours = draw(drawing);
  const double apex = -drawing.shape.base_height - drawing.shape.epi_length;
  Contour tip{9, Side::epi, {}, {}, {}};  // of 2 mm, moved by 4 mm
  for (int k = 0; k < 12; ++k)
    tip.points.push_back(drawing.frame.to_image(
        {4.0 + 2.0 * std::cos(2.0 * pi * k / 12), 2.0 * std::sin(2.0 * pi * k / 12), apex + 1.0}));
  contours.short_axis.push_back(tip);
  CHECK_THROWS_WITH(fit_spline_wall(contours, {}),
                    Contains("slice 9, epi: the long axis does not pass through the loop"));
  SplineFitParameters parameters;
  parameters.align_slices = true;
  const SplineWall wall = fit_spline_wall(contours, parameters);
  CHECK(
      notes_contain(wall, "slice 9 shows muscle without a cavity beside the long axis: left out"));
  check_volumes(wall, drawing.shape, 0.02);
}

TEST_CASE("a shifted slice beyond the limit is refused", "[unit][geometry]") {
  const Drawing drawing = in_scanner();
  Contours contours = draw(drawing);
  for (const std::size_t i : {6, 7})
    for (Vec3& x : contours.short_axis[i].points)
      x += 9.0 * drawing.frame.axes.col(0);
  SplineFitParameters parameters;
  parameters.largest_shift = 6.0;
  CHECK_THROWS_WITH(fit_spline_wall(contours, parameters),
                    Contains("slice 4 lies") && Contains("at most 6 mm"));
}

TEST_CASE("noise of the contours is smoothed", "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.noise = 0.7;
  SplineFitParameters parameters;
  parameters.correct_shifts = false;
  const SplineWall wall = fit_spline_wall(draw(drawing), parameters);
  check_volumes(wall, drawing.shape, 0.02);
  CHECK(farthest(wall, drawing) < 1.0);
  for (const auto& slice : wall.report().short_axis)
    CHECK(slice.endo->rms == Approx(0.7).margin(0.35));  // 40 points and the surface's freedom
}

TEST_CASE("the wall ends exactly on the base plane and starts on the long axis",
          "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.noise = 0.7;
  const SplineWall wall = fit_spline_wall(draw(drawing), {});
  for (int j = 0; j < 50; ++j)
    for (const double t : {0.0, 0.3, 1.0}) {
      CHECK(std::abs(wall.point(1.0, 0.13 * j, t).z()) < 1e-9);
      CHECK(std::abs(wall.point(1.0 - 1e-9, 0.13 * j, t).z()) < 1e-5);
      CHECK(wall.point(0.0, 0.13 * j, t).head<2>().norm() < 1e-9);
      CHECK((wall.point(0.0, 0.13 * j, t) - wall.point(0.0, 0.0, t)).norm() < 1e-9);
    }
}

TEST_CASE("theta turns anticlockwise seen from the base and depth is linear", "[unit][geometry]") {
  const SplineWall wall = fit_spline_wall(draw(in_scanner()), {});
  for (const double theta : {0.1, 1.5, 3.0}) {
    const Vec3 x = wall.point(0.6, theta, 0.4);
    CHECK(std::atan2(x.y(), x.x()) == Approx(theta).margin(1e-9));
    CHECK((x - 0.6 * wall.point(0.6, theta, 0.0) - 0.4 * wall.point(0.6, theta, 1.0)).norm() <
          1e-12);
  }
}

TEST_CASE("the surfaces are smooth at the apex", "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.noise = 1.0;  // so that the pole is nothing special
  const SplineWall wall = fit_spline_wall(draw(drawing), {});
  for (const auto* surface : {&wall.endo(), &wall.epi()}) {
    const Vec3 normal = surface->normal(0.0, 0.0);
    CHECK(angle(normal, -Vec3::UnitZ()) > 1e-3);
    for (int j = 0; j < 24; ++j)
      CHECK(angle(surface->normal(1e-5, 2.0 * pi * j / 24), normal) < 1e-4);
  }
}

TEST_CASE("lines across the wall stand upright on it", "[unit][geometry]") {
  const SplineWall wall = fit_spline_wall(draw(in_scanner()), {});
  double sum = 0.0;
  constexpr int rows = 50;
  constexpr double h = 1e-4;
  for (int i = 1; i < rows; ++i) {
    const double u = static_cast<double>(i) / rows;
    const Vec3 across = wall.point(u, 0.5, 1.0) - wall.point(u, 0.5, 0.0);
    const Vec3 along = wall.point(u + h, 0.5, 0.5) - wall.point(u - h, 0.5, 0.5);
    sum += std::abs(0.5 * pi - angle(across, along));
    CHECK(std::abs(0.5 * pi - angle(across, along)) < 20.0 * pi / 180.0);
    CHECK(along.norm() / (2.0 * h) == Approx(90.0).margin(15.0));  // [mm], even spacing
  }
  CHECK(sum / (rows - 1) < 6.0 * pi / 180.0);
}

TEST_CASE("a fitted wall meshes without tangled elements", "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.noise = 0.7;
  const SplineWall wall = fit_spline_wall(draw(drawing), {});
  const auto map = [&](double u, double theta, double t) { return wall.point(u, theta, t); };
  CHECK(untangled(lv::mesh::wall_mesh(map, {3.0, 0})));
}

TEST_CASE("a slice without epicardium is interpolated and said", "[unit][geometry]") {
  const Drawing drawing = in_scanner();
  Contours contours = draw(drawing);
  contours.short_axis.erase(contours.short_axis.begin() + 5);
  const SplineWall wall = fit_spline_wall(contours, {});
  CHECK(notes_contain(wall, "slice 3 has no epicardium"));
  CHECK_FALSE(wall.report().short_axis[2].epi.has_value());
  check_volumes(wall, drawing.shape, 0.01);
}

TEST_CASE("a missing slice is interpolated and said", "[unit][geometry]") {
  const Drawing drawing = in_scanner();
  Contours contours = draw(drawing);
  contours.short_axis.erase(contours.short_axis.begin() + 6, contours.short_axis.begin() + 8);
  const SplineWall wall = fit_spline_wall(contours, {});
  check_volumes(wall, drawing.shape, 0.01);
}

TEST_CASE("short-axis contours alone close at an assumed apex", "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.long_axis = false;
  drawing.apex = false;
  Contours contours = draw(drawing);
  SECTION("numbered from the base") {}
  SECTION("numbered from the apex") {
    for (Contour& c : contours.short_axis)
      c.slice = 9 - c.slice;
    std::reverse(contours.short_axis.begin(), contours.short_axis.end());
  }
  const SplineWall wall = fit_spline_wall(contours, {});
  CHECK(notes_contain(wall, "no contour shows the endocardial apex"));
  CHECK(notes_contain(wall, "no contour shows the epicardial apex"));
  CHECK(angle(wall.frame().axes.col(2), drawing.frame.axes.col(2)) < 1e-6);
  check_volumes(wall, drawing.shape, 0.02);
}

TEST_CASE("an apex that no contour shows is not as thick as slices cut the wall askew",
          "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.long_axis = false;
  drawing.apex = false;
  const int intervals = GENERATE(9, 11);  // down to half a millimetre before the cavity's tip
  drawing.spacing = 79.5 / intervals;
  drawing.slices = intervals + 1;
  const SplineWall wall = fit_spline_wall(draw(drawing), {});
  const double thickness = wall.point(0.0, 0.0, 0.0).z() - wall.point(0.0, 0.0, 1.0).z();
  const double drawn = drawing.shape.epi_length - drawing.shape.endo_length;
  CHECK(thickness == Approx(drawn).margin(2.5));  // in the last slice: 3.5 mm more
}

TEST_CASE("x points to the septum, else to the first point of the basal loop", "[unit][geometry]") {
  const Drawing drawing = in_scanner();
  const Contours contours = draw(drawing);
  CHECK(angle(model_frame(contours, {}).axes.col(0), drawing.frame.axes.col(0)) < 1e-6);
  const Vec3 septum = drawing.frame.to_image({-5.0, 30.0, -20.0});
  const Frame frame =
      model_frame(contours, {BasePlane::long_axis, {{septum.x(), septum.y(), septum.z()}}});
  CHECK(frame.to_model(septum).y() == Approx(0.0).margin(1e-9));
  CHECK(frame.to_model(septum).x() > 0.0);
  const Vec3 on_axis = drawing.frame.to_image({0.0, 0.2, -40.0});
  CHECK_THROWS_WITH(
      model_frame(contours, {BasePlane::long_axis, {{on_axis.x(), on_axis.y(), on_axis.z()}}}),
      Contains("septum point") && Contains("lies on the long axis"));
}

TEST_CASE("the base plane may be the basal slice's own", "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.tilt = 0.15;
  const Contours contours = draw(drawing);
  const Frame frame = model_frame(contours, {BasePlane::basal_slice, {}});
  for (const Vec3& x : contours.short_axis[0].points)
    CHECK(std::abs(frame.to_model(x).z()) < 1e-6);
  CHECK(frame.axes.determinant() == Approx(1.0));
}

TEST_CASE("a wall that is too thin or crosses itself is refused by place", "[unit][geometry]") {
  Drawing drawing = in_scanner();
  drawing.shape.epi_radius = 22.0;
  SplineFitParameters parameters;
  parameters.thinnest_wall = 4.0;
  CHECK_THROWS_WITH(fit_spline_wall(draw(drawing), parameters),
                    Contains("the wall is only 2.") && Contains("mm thick at z = ") &&
                        Contains("degrees, near slice ") && Contains("at least 4 mm"));

  Contours contours = draw(in_scanner());
  for (Contour& c : contours.apex)
    if (c.side == Side::endo)
      c.points[0] -= 25.0 * drawing.frame.axes.col(2);
  for (Contour& c : contours.long_axis)
    c.points.erase(c.points.begin() + 8, c.points.end() - 8);
  CHECK_THROWS_WITH(fit_spline_wall(contours, {}),
                    Contains("the fitted endocardium lies") && Contains("outside the epicardium"));
}

TEST_CASE("folded contours are refused by place", "[unit][geometry]") {
  const Drawing drawing = in_scanner();
  Contours contours = draw(drawing);
  SplineFitParameters parameters;
  parameters.correct_shifts = false;
  SECTION("a loop with a pocket behind a papillary muscle") {
    auto& points = contours.short_axis[4].points;
    const Vec3 centre = drawing.frame.to_image({0.0, 0.0, -20.0});
    const auto at = [&](double radius, double theta) -> Vec3 {
      return centre +
             drawing.frame.axes * Vec3(radius * std::cos(theta), radius * std::sin(theta), 0.0);
    };
    points[10] = at(20.0, 1.95);  // out, back behind and in again
    points[11] = at(10.0, 1.60);
    points[12] = at(10.0, 1.95);
    CHECK_THROWS_WITH(fit_spline_wall(contours, parameters),
                      Contains("slice 3, endo: the loop is folded as seen from the long axis, at z "
                               "= -20.0 mm, angle"));
  }
  SECTION("a loop beside the long axis") {
    for (const std::size_t i : {6, 7})
      for (Vec3& x : contours.short_axis[i].points)
        x += 26.0 * drawing.frame.axes.col(0);
    CHECK_THROWS_WITH(fit_spline_wall(contours, parameters),
                      Contains("slice 4, endo: the long axis does not pass through the loop"));
  }
}
