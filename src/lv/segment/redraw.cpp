#include "lv/segment/redraw.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/segment/redraw_border.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace lv::segment {
namespace {

using geometry::Side;
using image::Plane;

/// A closed line of at least three points round a centre; none if there is none.
std::optional<Radii> stands(const Plane& plane, const Pixel& centre,
                            const std::vector<Vec3>& line) {
  if (line.size() < 3)
    return std::nullopt;
  const PolarGrid grid;
  return radii_of(plane, centre, line, grid.rays).max(grid.first).min(grid.last());
}

/// The middle of what shows best where the cavity is.
Pixel middle(const Plane& plane, const BorderWish& wish) {
  const auto& shows = wish.endo.size() >= 3  ? wish.endo
                      : wish.epi.size() >= 3 ? wish.epi
                                             : wish.points;
  return plane.pixel(geometry::mean_of(shows)).head<2>();
}

/// How large the blood is [mm]: within an epicardium it fills six tenths of the radius or more.
double blood_radius(const Redrawing& asked) {
  constexpr double of_epicardium = 0.6;
  if (asked.endo)
    return asked.endo->mean();
  if (asked.epi)
    return of_epicardium * asked.epi->mean();
  double sum = 0.0;
  for (const PolarPoint& p : asked.points)
    sum += p.radius;
  const double mean = sum / static_cast<double>(asked.points.size());
  return asked.side == Side::endo ? mean : of_epicardium * mean;
}

Redrawing in_polar_picture(const Plane& plane, const BorderWish& wish) {
  Redrawing asked;
  asked.side = wish.side;
  asked.frame = wish.frame;
  asked.centre.at = middle(plane, wish);
  asked.endo = stands(plane, asked.centre.at, wish.endo);
  asked.epi = stands(plane, asked.centre.at, wish.epi);
  for (const Vec3& x : wish.points)
    asked.points.push_back(polar_of(plane, asked.centre.at, x));
  asked.centre.radius = blood_radius(asked);
  return asked;
}

void check(const Redrawing& asked, const std::string& where) {
  const double last = PolarGrid{}.last();
  if (!asked.endo && !asked.epi && asked.points.size() < 3)
    throw InputError(where, fmt::format("{} points, where no border stands", asked.points.size()),
                     "Set three points or more round the blood");
  for (const PolarPoint& p : asked.points)
    if (p.radius > last)
      throw InputError(
          where, fmt::format("a point lies {:.0f} mm from the middle of the ventricle", p.radius),
          fmt::format("Set points within {:.0f} mm", last));
}

/// The points of the rays, or those of the observer where they lie.
std::vector<Vec3> with_points(std::vector<Vec3> line, const Redrawing& asked,
                              const std::vector<Vec3>& points) {
  const auto rays = static_cast<int>(line.size());
  std::vector<std::pair<double, Vec3>> all;
  std::vector<char> taken(line.size(), 0);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const double angle = asked.points[n].angle;
    const int ray = nearest_ray(angle, rays);
    taken[static_cast<std::size_t>(ray)] = 1;
    // the ray's own turn, so that a point just before the first ray does not become the last
    const double aside = std::remainder(angle - ray_angle(ray, rays), 2.0 * std::numbers::pi);
    all.emplace_back(ray_angle(ray, rays) + aside, points[n]);
  }
  for (int ray = 0; ray < rays; ++ray)
    if (taken[static_cast<std::size_t>(ray)] == 0)
      all.emplace_back(ray_angle(ray, rays), line[static_cast<std::size_t>(ray)]);
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  line.clear();
  for (const auto& [angle, x] : all)
    line.push_back(x);
  return line;
}

}  // namespace

std::vector<Vec3> redraw(const image::CineSlice& slice, const BorderWish& wish, double fall,
                         const std::string& where) {
  if (wish.points.empty())
    throw InputError(where, "there is no point to draw a border through", "Set a point");
  const Plane& plane = slice.frames.at(wish.frame).plane;
  const Redrawing asked = in_polar_picture(plane, wish);
  check(asked, where);
  const Radii radii = redraw_border(slice, asked, fall);
  return with_points(line(plane, asked.centre.at, radii), asked, wish.points);
}

}  // namespace lv::segment
