#include "lv/geometry/fit_report.hpp"

#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/long_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace lv::geometry {
namespace {

using std::numbers::pi;

/// The surfaces and the contours they belong to.
struct Fitted {
  const Frame& frame;
  const StarSurface& endo;
  const StarSurface& epi;
  double margin;

  [[nodiscard]] const StarSurface& surface(Side side) const {
    return side == Side::endo ? endo : epi;
  }
};

/// Residual of the points of some contours up to `highest`; none if there are none.
std::optional<Residual> residual(const std::vector<const Contour*>& contours, const Fitted& fitted,
                                 double highest) {
  Residual r;
  for (const Contour* c : contours)
    for (const Vec3& image : c->points) {
      const Vec3 x = fitted.frame.to_model(image);
      if (x.z() > highest)
        continue;
      const double d = std::abs(fitted.surface(c->side).distance(x));
      ++r.points;
      r.mean += d;
      r.rms += d * d;
      r.max = std::max(r.max, d);
    }
  if (r.points == 0)
    return std::nullopt;
  r.mean /= r.points;
  r.rms = std::sqrt(r.rms / r.points);
  return r;
}

ImageReport image_report(const std::vector<Contour>& set, int slice, const Fitted& fitted,
                         double highest) {
  ImageReport report;
  report.slice = slice;
  if (const Contour* endo = find(set, slice, Side::endo))
    report.endo = residual({endo}, fitted, highest);
  if (const Contour* epi = find(set, slice, Side::epi))
    report.epi = residual({epi}, fitted, highest);
  return report;
}

ImageReport short_axis_report(const Contours& contours, int slice, const Fitted& fitted) {
  ImageReport report =
      image_report(contours.short_axis, slice, fitted, std::numeric_limits<double>::infinity());
  if (const Contour* endo = find(contours.short_axis, slice, Side::endo))
    report.endo_area = enclosed_area(*endo);
  if (const Contour* epi = find(contours.short_axis, slice, Side::epi))
    report.epi_area = enclosed_area(*epi);
  return report;
}

/// All slices with a loop, from the base to the apex: those of the endocardium, then those of the
/// epicardium beyond it.
std::vector<int> all_slices(const Contours& contours) {
  std::vector<int> slices = slices_from_base(contours);
  for (const Contour* epi : loops_from_base(contours, Side::epi))
    if (find(contours.short_axis, epi->slice, Side::endo) == nullptr)
      slices.push_back(epi->slice);
  return slices;
}

std::optional<Residual> apex_residual(const Contours& contours, Side side, const Fitted& fitted) {
  std::vector<const Contour*> points;
  for (const Contour& c : contours.apex)
    if (c.side == side)
      points.push_back(&c);
  return residual(points, fitted, fitted.margin);
}

/// The slice whose endocardium's centre is nearest in height.
int nearest_slice(const Contours& contours, const Frame& frame, double z) {
  int slice = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Contour& c : contours.short_axis) {
    const double distance = std::abs(frame.to_model(mean_of(c.points)).z() - z);
    if (c.side == Side::endo && distance < nearest) {
      nearest = distance;
      slice = c.slice;
    }
  }
  return slice;
}

/// Points of a surface up to its base, about 2 mm apart.
std::vector<Vec3> spread_over(const StarSurface& surface) {
  constexpr int rows = 60;
  constexpr int angles = 120;
  std::vector<Vec3> points;
  for (int j = 0; j < angles; ++j) {
    const double theta = 2.0 * pi * j / angles;
    const double base = surface.base_angle(theta);
    for (int i = 0; i <= rows; ++i)
      points.push_back(surface.point(base * i / rows, theta));
  }
  return points;
}

/// How far x lies inside a surface. The search for the nearest point can go astray where x is as
/// far away as the surface is curved, in a thick wall: then the nearest of `points` on it tells.
double depth_below(const StarSurface& surface, const std::vector<Vec3>& points, const Vec3& x) {
  constexpr double between_points = 3.0;  // [mm]
  const double depth = -surface.distance(x);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points)
    nearest = std::min(nearest, (p - x).squaredNorm());
  nearest = std::sqrt(nearest);
  return std::abs(depth) < nearest - between_points || std::abs(depth) > nearest + between_points
             ? std::copysign(nearest, -surface.level(x).value)
             : depth;
}

void measure_thickness(const Contours& contours, const Fitted& fitted, FitReport& report) {
  constexpr int rows = 40;
  constexpr int angles = 72;
  const std::vector<Vec3> outside = spread_over(fitted.epi);
  report.thinnest.value = std::numeric_limits<double>::infinity();
  report.thickest.value = -std::numeric_limits<double>::infinity();
  for (int j = 0; j < angles; ++j) {
    const double theta = 2.0 * pi * j / angles;
    const double base = fitted.endo.base_angle(theta);
    for (int i = 0; i <= rows; ++i) {
      const Vec3 x = fitted.endo.point(base * i / rows, theta);
      const double thickness = depth_below(fitted.epi, outside, x);
      if (thickness < report.thinnest.value)
        report.thinnest = {thickness, x, 0};
      if (thickness > report.thickest.value)
        report.thickest = {thickness, x, 0};
    }
  }
  for (Thickness* t : {&report.thinnest, &report.thickest})
    t->slice = nearest_slice(contours, fitted.frame, t->at.z());
}

/// The angle between the long axis and the normal of the most basal slice.
double slice_tilt(const Contours& contours) {
  const Contour& basal = *find(contours.short_axis, slices_from_base(contours).front(), Side::endo);
  const double cosine = plane_of(basal.points).axes.col(2).dot(long_axis(contours).up);
  return std::acos(std::min(1.0, std::abs(cosine)));
}

}  // namespace

SlabVolumes slab_volumes(const Contours& contours) {
  const double usual = slice_spacing(contours);
  const std::vector<int> slices = all_slices(contours);
  const Vec3 normal =
      plane_of(find(contours.short_axis, slices.front(), Side::endo)->points).axes.col(2);
  std::vector<double> heights;
  for (const int slice : slices) {
    const Contour* endo = find(contours.short_axis, slice, Side::endo);
    const Contour* any = endo != nullptr ? endo : find(contours.short_axis, slice, Side::epi);
    heights.push_back(mean_of(any->points).dot(normal));
  }
  SlabVolumes volumes;
  for (std::size_t k = 0; k < slices.size(); ++k) {
    const double above = k > 0 ? std::abs(heights[k] - heights[k - 1]) : usual;
    const double below = k + 1 < slices.size() ? std::abs(heights[k + 1] - heights[k]) : usual;
    const double thickness = 0.5 * (above + below);
    const Contour* endo = find(contours.short_axis, slices[k], Side::endo);
    const Contour* epi = find(contours.short_axis, slices[k], Side::epi);
    const double cavity = endo != nullptr ? enclosed_area(*endo) : 0.0;
    volumes.cavity += cavity * thickness;
    if (epi != nullptr) {
      volumes.wall += (enclosed_area(*epi) - cavity) * thickness;
      ++volumes.wall_slices;
    }
  }
  return volumes;
}

FitReport measure_fit(const Contours& contours, const Frame& frame, const StarSurface& endo,
                      const StarSurface& epi, double margin) {
  const Fitted fitted{frame, endo, epi, margin};
  FitReport report;
  for (const int slice : all_slices(contours))
    report.short_axis.push_back(short_axis_report(contours, slice, fitted));
  std::set<int> images;
  for (const Contour& c : contours.long_axis)
    images.insert(c.slice);
  for (const int slice : images)
    report.long_axis.push_back(image_report(contours.long_axis, slice, fitted, margin));
  report.apex_endo = apex_residual(contours, Side::endo, fitted);
  report.apex_epi = apex_residual(contours, Side::epi, fitted);
  report.volume_cavity = endo.enclosed_volume();
  report.volume_wall = epi.enclosed_volume() - report.volume_cavity;
  const SlabVolumes slabs = slab_volumes(contours);
  report.contour_cavity = slabs.cavity;
  report.contour_wall = slabs.wall;
  report.wall_slices = slabs.wall_slices;
  report.slice_spacing = slice_spacing(contours);
  report.base_height =
      -frame.to_model(mean_of(loops_from_base(contours, Side::endo).front()->points)).z() + 0.0;
  measure_thickness(contours, fitted, report);
  report.slice_tilt = slice_tilt(contours);
  return report;
}

}  // namespace lv::geometry
