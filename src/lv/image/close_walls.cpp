#include "lv/image/close_walls.hpp"

#include "lv/base/check.hpp"
#include "lv/base/median.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/long_axis.hpp"
#include "lv/geometry/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::image {
namespace {

using geometry::Contour;
using geometry::Contours;
using geometry::Frame;
using geometry::Side;
using Vec2 = Eigen::Vector2d;

using std::numbers::pi;
constexpr int rays = 180;
constexpr int most_missing = rays / 3;

std::vector<Vec2> in_plane(const Contour& loop, const Frame& plane) {
  std::vector<Vec2> points;
  for (const Vec3& x : loop.points)
    points.emplace_back(plane.to_model(x).head<2>());
  return points;
}

/// Radius of the endocardium and thickness of the wall along each ray.
struct Wall {
  std::vector<double> inner, thickness;
  std::vector<int> there;  ///< rays on which the wall is not missing
};

/// The rays between which thickness is interpolated: not those where it is less than `least`, nor
/// their neighbours up to where the wall has half its usual thickness, for an open wall tapers.
std::vector<int> rays_there(const std::vector<double>& thickness, double least) {
  const double half = 0.5 * median(thickness);
  std::vector<bool> missing(rays);
  for (int k = 0; k < rays; ++k) {
    if (thickness[k] >= least)
      continue;
    for (const int step : {1, rays - 1})
      for (int at = k, n = 0; n < rays && (n == 0 || thickness[at] < half);
           ++n, at = (at + step) % rays)
        missing[at] = true;
  }
  std::vector<int> there;
  for (int k = 0; k < rays; ++k)
    if (!missing[k])
      there.push_back(k);
  return there;
}

Vec2 direction(int k) {
  return {std::cos(2.0 * pi * k / rays), std::sin(2.0 * pi * k / rays)};
}

Wall measure(const Contour& endo, const Contour& epi, const Frame& plane, double least) {
  const auto inside = in_plane(endo, plane);
  const auto outside = in_plane(epi, plane);
  Wall wall;
  for (int k = 0; k < rays; ++k) {
    wall.inner.push_back(geometry::farthest_crossing(inside, direction(k)));
    wall.thickness.push_back(geometry::farthest_crossing(outside, direction(k)) -
                             wall.inner.back());
  }
  wall.there = rays_there(wall.thickness, least);
  return wall;
}

/// The epicardium with the thickness interpolated over missing rays.
std::vector<Vec3> bridged(const Wall& wall, const Frame& plane) {
  std::vector<Vec3> points;
  for (std::size_t n = 0; n < wall.there.size(); ++n) {
    const int from = wall.there[n];
    const int gap = (wall.there[(n + 1) % wall.there.size()] - from + rays - 1) % rays + 1;
    const double first = wall.thickness[from];
    const double next = wall.thickness[(from + gap) % rays];
    for (int k = 0; k < gap; ++k) {
      const int at = (from + k) % rays;
      const Vec2 x = (wall.inner[at] + first + (next - first) * k / gap) * direction(at);
      points.push_back(plane.to_image({x.x(), x.y(), 0.0}));
    }
  }
  return points;
}

/// Whether the epicardium stays.
bool close_wall(const Contour& endo, Contour& epi, double least, std::vector<std::string>& notes) {
  const Frame plane = geometry::plane_of(endo.points);
  const Wall wall = measure(endo, epi, plane, least);
  const int missing = rays - static_cast<int>(wall.there.size());
  if (missing == 0)
    return true;
  const std::string over = fmt::format(
      "slice {}: the wall is open or thinner than {:g} mm; with where it tapers, over {} degrees",
      endo.slice, least, 360 * missing / rays);
  if (missing > most_missing) {
    notes.push_back(over + ": its epicardium is left out");
    return false;
  }
  notes.push_back(over + ": its thickness is interpolated there");
  epi.points = bridged(wall, plane);
  epi.lines.clear();
  return true;
}

double middle_distance(const Contour& a, const Contour& b) {
  return (geometry::mean_of(a.points) - geometry::mean_of(b.points)).norm();
}

/// Whether an outer contour is drawn somewhere else than round the inner one of its slice.
bool is_stray(const Contour& endo, const Contour& epi) {
  return !geometry::encloses(in_plane(epi, geometry::plane_of(endo.points)), Vec2::Zero()) ||
         middle_distance(endo, epi) > 0.5 * geometry::mean_radius(epi);
}

/// The wall's thickness along each ray; empty where a loop is no loop.
std::vector<double> thickness_of(const Contour& endo, const Contour& epi) {
  if (endo.points.size() < 3 || epi.points.size() < 3)
    return {};
  return measure(endo, epi, geometry::plane_of(endo.points), 0.0).thickness;
}

/// The usual thickness of all slices but one; 0 if none has an epicardium.
double usual_thickness(const Contours& contours, int but) {
  std::vector<double> all;
  for (const Contour& epi : contours.short_axis) {
    const Contour* endo = geometry::find(contours.short_axis, epi.slice, Side::endo);
    if (epi.side != Side::epi || epi.slice == but || endo == nullptr)
      continue;
    const auto rays_of_slice = thickness_of(*endo, epi);
    all.insert(all.end(), rays_of_slice.begin(), rays_of_slice.end());
  }
  return all.empty() ? 0.0 : median(std::move(all));
}

/// The part of the way round a slice on which it shows muscle, thicker than `least`; 1 if it shows
/// no epicardium at all.
double part_with_muscle(const Contours& contours, int slice, double least) {
  const Contour* endo = geometry::find(contours.short_axis, slice, Side::endo);
  const Contour* epi = geometry::find(contours.short_axis, slice, Side::epi);
  if (endo == nullptr || epi == nullptr)
    return 1.0;
  const auto thickness = thickness_of(*endo, *epi);
  if (thickness.empty())
    return 1.0;
  const auto muscle =
      std::count_if(thickness.begin(), thickness.end(), [&](double t) { return t >= least; });
  return static_cast<double>(muscle) / rays;
}

}  // namespace

void drop_strays(Contours& contours, std::vector<std::string>& notes) {
  std::vector<std::string> strays;
  std::string first;
  const auto outer_loops = [&] {
    return std::count_if(contours.short_axis.begin(), contours.short_axis.end(),
                         [](const Contour& c) { return c.side == Side::epi; });
  };
  const auto drawn = outer_loops();
  std::vector<Contour> kept;
  for (const Contour& loop : contours.short_axis) {
    const Contour* endo = geometry::find(contours.short_axis, loop.slice, Side::endo);
    if (loop.side == Side::endo || endo == nullptr || !is_stray(*endo, loop)) {
      kept.push_back(loop);
      continue;
    }
    if (strays.empty())
      first = loop.where();
    strays.push_back(
        fmt::format("slice {}: the outer contour lies off the heart, its middle {:.0f} mm from "
                    "that of the inner one",
                    loop.slice, middle_distance(*endo, loop)));
  }
  contours.short_axis = std::move(kept);
  if (!strays.empty() && outer_loops() == 0)
    throw InputError(
        first,
        fmt::format("{}{}", strays.front(), drawn == 1 ? "" : fmt::format("; so do all {}", drawn)),
        "The outer contours belong to other images or coordinates: give those of this heart");
  for (const std::string& stray : strays)
    notes.push_back(stray + ": not used");
}

void drop_open_base(Contours& contours, std::vector<std::string>& notes) {
  constexpr std::ptrdiff_t least_left = 3;
  constexpr double thin = 1.0 / 3.0;  // of the usual thickness
  const auto slices_left = [&] {
    return std::count_if(contours.short_axis.begin(), contours.short_axis.end(),
                         [](const Contour& c) { return c.side == Side::endo; });
  };
  while (slices_left() > least_left) {
    const int slice = geometry::slices_from_base(contours).front();
    const double least = thin * usual_thickness(contours, slice);
    const double part = part_with_muscle(contours, slice, least);
    if (part >= 0.5)
      return;
    notes.push_back(
        fmt::format("slice {}, the most basal: muscle ({:.1f} mm and more) surrounds {:.0f}% of "
                    "the cavity, less than half: left out, as it shows the valve or the atrium",
                    slice, least, 100.0 * part));
    std::erase_if(contours.short_axis, [&](const Contour& c) { return c.slice == slice; });
  }
}

void close_walls(Contours& contours, double least, std::vector<std::string>& notes) {
  std::vector<Contour> kept;
  for (Contour& loop : contours.short_axis) {
    const Contour* endo = geometry::find(contours.short_axis, loop.slice, Side::endo);
    if (loop.side == Side::endo || endo == nullptr || endo->points.size() < 3 ||
        loop.points.size() < 3 || close_wall(*endo, loop, least, notes))
      kept.push_back(loop);
  }
  contours.short_axis = std::move(kept);
}

}  // namespace lv::image
