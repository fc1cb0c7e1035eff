#include "lv/segment/redraw.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_measures.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace lv;
using geometry::Side;
using segment::BorderWish;

namespace {

constexpr double endo_radius = 20.0;
constexpr double epi_radius = 30.0;

/// Five frames of a ring of muscle round blood, between fat and lung, with a grain of noise.
image::CineSlice ring() {
  image::Picture picture;
  picture.plane.origin = {-70.0, -70.0, 5.0};
  picture.plane.spacing_i = picture.plane.spacing_j = 1.4;
  picture.plane.columns = picture.plane.rows = 100;
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 100; ++i) {
      const Vec3 x = picture.plane.point(i, j);
      const double r = std::hypot(x.x(), x.y());
      const auto edge = [&](double at) { return 0.5 + 0.5 * std::tanh((r - at) / 1.2); };
      const double outside = x.x() > 0.0 ? 20.0 : 220.0;
      const double grey = 300.0 - 200.0 * edge(endo_radius) + (outside - 100.0) * edge(epi_radius);
      picture.values.push_back(static_cast<float>(grey + (i * 7919 + j * 104729) % 11 - 5));
    }
  return {"ring", {5, picture}, {}, 0.0};
}

Vec3 at(double degrees, double radius) {
  const double a = degrees * std::numbers::pi / 180.0;
  return {radius * std::cos(a), radius * std::sin(a), 5.0};
}

std::vector<Vec3> round_line(double radius) {
  std::vector<Vec3> line;
  for (int i = 0; i < 72; ++i)
    line.push_back(at(5.0 * i, radius));
  return line;
}

/// The farthest of a line's points from a circle, of those that lie so many degrees from the x
/// axis.
double off_circle(const std::vector<Vec3>& line, double radius, double beyond = 0.0) {
  double most = 0.0;
  for (const Vec3& x : line)
    if (std::abs(std::atan2(x.y(), x.x())) * 180.0 / std::numbers::pi >= beyond)
      most = std::max(most, std::abs(std::hypot(x.x(), x.y()) - radius));
  return most;
}

bool holds(const std::vector<Vec3>& line, const Vec3& point) {
  return std::any_of(line.begin(), line.end(),
                     [&](const Vec3& x) { return (x - point).norm() < 1e-9; });
}

std::vector<Vec3> redraw(const BorderWish& wish) {
  return segment::redraw(ring(), wish, 0.5, "test");
}

}  // namespace

TEST_CASE("a border redrawn from one point of it follows it all round", "[segment]") {
  for (const double degrees : {0.0, 2.0, 91.0, -178.0}) {
    const Vec3 point = at(degrees, endo_radius);
    const auto endo = redraw(
        {.side = Side::endo, .frame = 2, .points = {point}, .endo = round_line(15.0), .epi = {}});
    CHECK(holds(endo, point));
    CHECK(off_circle(endo, endo_radius) < 1.0);
    const Vec3 outer = at(degrees, epi_radius);
    const auto epi = redraw({.side = Side::epi,
                             .frame = 2,
                             .points = {outer},
                             .endo = round_line(endo_radius),
                             .epi = round_line(33.0)});
    CHECK(holds(epi, outer));
    CHECK(off_circle(epi, epi_radius) < 1.0);
  }
}

TEST_CASE("a point off the border is obeyed, and the border beside it followed", "[segment]") {
  for (const double radius : {15.0, 24.0}) {
    const Vec3 point = at(0.0, radius);
    const auto line = redraw({.side = Side::endo,
                              .frame = 0,
                              .points = {point},
                              .endo = round_line(endo_radius),
                              .epi = round_line(epi_radius)});
    CHECK(holds(line, point));
    CHECK(off_circle(line, endo_radius, 60.0) < 1.0);
    // no spike: the points beside it lie between
    const auto found = std::find_if(line.begin(), line.end(),
                                    [&](const Vec3& x) { return (x - point).norm() < 1e-9; });
    const auto n = static_cast<std::size_t>(found - line.begin());
    for (const std::size_t beside : {(n + 1) % line.size(), (n + line.size() - 1) % line.size()})
      CHECK(std::abs(line[beside].head<2>().norm() - radius) < 1.0);
  }
}

TEST_CASE("three points draw a border where none stands", "[segment]") {
  const std::vector<Vec3> points{at(10.0, endo_radius), at(130.0, endo_radius),
                                 at(250.0, endo_radius)};
  const auto line =
      redraw({.side = Side::endo, .frame = 1, .points = points, .endo = {}, .epi = {}});
  for (const Vec3& point : points)
    CHECK(holds(line, point));
  CHECK(off_circle(line, endo_radius) < 1.0);
  CHECK_THROWS_WITH(
      redraw({.side = Side::endo, .frame = 1, .points = {points[0]}, .endo = {}, .epi = {}}),
      Catch::Contains("where no border stands"));
  CHECK_THROWS_WITH(redraw({.side = Side::endo,
                            .frame = 1,
                            .points = {at(0.0, 80.0)},
                            .endo = round_line(endo_radius),
                            .epi = {}}),
                    Catch::Contains("80 mm from the middle"));
}

TEST_CASE("a redrawn line goes round once, from the first ray on", "[segment]") {
  const auto line = redraw({.side = Side::endo,
                            .frame = 0,
                            .points = {at(-1.0, endo_radius), at(1.5, endo_radius), at(37.0, 21.0)},
                            .endo = round_line(endo_radius),
                            .epi = {}});
  double turned = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3& a = line[i];
    const Vec3& b = line[(i + 1) % line.size()];
    const double step = std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
    CHECK(step > 0.0);
    largest = std::max(largest, step);
    turned += step;
  }
  CHECK(turned == Approx(2.0 * std::numbers::pi));
  CHECK(largest < 0.2);
}
