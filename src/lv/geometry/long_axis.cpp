#include "lv/geometry/long_axis.hpp"

#include "lv/base/check.hpp"
#include "lv/base/median.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/polygon.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lv::geometry {
namespace {

/// The point of a long-axis curve farthest from the chord between its ends.
Vec3 tip(const Contour& curve) {
  const Vec3 start = curve.points.front();
  const Vec3 chord = (curve.points.back() - start).normalized();
  const auto distance = [&](const Vec3& x) { return (x - start).cross(chord).norm(); };
  return *std::max_element(curve.points.begin(), curve.points.end(),
                           [&](const Vec3& x, const Vec3& y) { return distance(x) < distance(y); });
}

/// What the contours show of the apex of one surface.
std::vector<Vec3> apex_points(const Contours& contours, Side side) {
  std::vector<Vec3> points;
  for (const Contour& c : contours.apex)
    if (c.side == side)
      points.push_back(c.points.front());
  if (points.empty())
    for (const Contour& c : contours.long_axis)
      if (c.side == side)
        points.push_back(tip(c));
  return points;
}

std::vector<const Contour*> endo_loops(const Contours& contours) {
  std::vector<const Contour*> loops;
  for (const Contour& c : contours.short_axis)
    if (c.side == Side::endo)
      loops.push_back(&c);
  return loops;
}

/// Whether the first slice is the most apical one.
bool starts_at_apex(const Contours& contours) {
  const auto loops = endo_loops(contours);
  std::vector<Vec3> apex = apex_points(contours, Side::endo);
  if (apex.empty())
    apex = apex_points(contours, Side::epi);
  if (apex.empty())
    return mean_radius(*loops.front()) < mean_radius(*loops.back());
  const Vec3 at = mean_of(apex);
  return (mean_of(loops.front()->points) - at).norm() < (mean_of(loops.back()->points) - at).norm();
}

/// The points that show the mitral annulus; none if nothing does.
std::vector<Vec3> annulus_points(const Contours& contours) {
  std::vector<Vec3> points = contours.annulus;
  if (points.empty())
    for (const Contour& c : contours.long_axis)
      if (c.side == Side::endo) {
        points.push_back(c.points.front());
        points.push_back(c.points.back());
      }
  return points;
}

/// From the centre of the most basal endocardial loop to a point of the base plane.
Vec3 base_offset(const Contours& contours, const Vec3& basal_centre, BaseAt at) {
  if (at == BaseAt::slice)
    return Vec3::Zero();
  if (at == BaseAt::slab)
    return basal_slab(contours);
  const auto points = annulus_points(contours);
  if (points.empty())
    throw InputError(contours.short_axis.front().where(),
                     "no point of the mitral annulus and no long-axis curve shows the base",
                     "Lay the base plane in the most basal slice or at the end of its slab");
  return mean_of(points) - basal_centre;
}

/// The centre of an endocardial loop, or the apex.
struct Centre {
  Vec3 x;
  double radius;  ///< of the loop; of the last one for the apex [mm]
};

/// From the base to the apex.
std::vector<Centre> centres_of(const Contours& contours) {
  std::vector<Centre> centres;
  for (const Contour* loop : loops_from_base(contours, Side::endo))
    centres.push_back({mean_of(loop->points), mean_radius(*loop)});
  if (shows_apex(contours, Side::endo))
    centres.push_back({mean_of(apex_points(contours, Side::endo)), centres.back().radius});
  return centres;
}

/// The line from which the weighted squares of the centres' distances are least.
template <class Weight>
LongAxis line_through(const std::vector<Centre>& centres, const Weight& weight) {
  LongAxis axis{Vec3::Zero(), Vec3::Zero()};
  double total = 0.0;
  for (const Centre& c : centres) {
    axis.point += weight(c) * c.x;
    total += weight(c);
  }
  axis.point /= total;
  Mat3 scatter = Mat3::Zero();
  for (const Centre& c : centres)
    scatter += weight(c) * (c.x - axis.point) * (c.x - axis.point).transpose();
  axis.up = Eigen::SelfAdjointEigenSolver<Mat3>(scatter).eigenvectors().col(2);
  if (axis.up.dot(centres.front().x - centres.back().x) < 0.0)
    axis.up = -axis.up;
  return axis;
}

/// Whether a line passes through all endocardial loops.
bool passes_within(const LongAxis& axis, const Contours& contours) {
  const auto loops = endo_loops(contours);
  return std::all_of(loops.begin(), loops.end(), [&](const Contour* loop) {
    Frame frame;
    frame.origin = axis.point;
    frame.axes.col(2) = axis.up;
    frame.axes.col(0) = axis.up.unitOrthogonal();
    frame.axes.col(1) = axis.up.cross(frame.axes.col(0));
    Polygon seen;
    for (const Vec3& x : loop->points)
      seen.emplace_back(frame.to_model(x).head<2>());
    return encloses(seen, Eigen::Vector2d::Zero());
  });
}

Vec3 across(const Vec3& direction, const Vec3& axis) {
  return direction - direction.dot(axis) * axis;
}

/// The direction of x before it is made normal to z.
Vec3 x_direction(const Contour& basal, const Vec3& origin, const Vec3& z,
                 const FrameParameters& parameters) {
  if (!parameters.septum)
    return across(basal.points.front() - mean_of(basal.points), z);
  const auto& septum = *parameters.septum;
  Vec3 x = across(Vec3(septum[0], septum[1], septum[2]) - origin, z);
  if (x.norm() < 1.0)
    throw InputError("septum point",
                     fmt::format("the point ({:.1f}, {:.1f}, {:.1f}) mm lies on the long axis",
                                 septum[0], septum[1], septum[2]),
                     "Give a point in the wall between the two ventricles, in scanner mm");
  return x;
}

}  // namespace

std::vector<int> slices_from_base(const Contours& contours) {
  std::vector<int> slices;
  for (const Contour* loop : endo_loops(contours))
    slices.push_back(loop->slice);
  if (starts_at_apex(contours))
    std::reverse(slices.begin(), slices.end());
  return slices;
}

bool shows_apex(const Contours& contours, Side side) {
  return !apex_points(contours, side).empty();
}

std::vector<const Contour*> loops_from_base(const Contours& contours, Side side) {
  const auto slices = slices_from_base(contours);
  const auto centre = [&](int slice) {
    return mean_of(find(contours.short_axis, slice, Side::endo)->points);
  };
  const Vec3 up = centre(slices.front()) - centre(slices.back());
  std::vector<const Contour*> loops;
  for (const Contour& c : contours.short_axis)
    if (c.side == side)
      loops.push_back(&c);
  std::stable_sort(loops.begin(), loops.end(), [&](const Contour* a, const Contour* b) {
    return mean_of(a->points).dot(up) > mean_of(b->points).dot(up);
  });
  return loops;
}

double slice_spacing(const Contours& contours) {
  const auto loops = loops_from_base(contours, Side::endo);
  const Vec3 normal = plane_of(loops.front()->points).axes.col(2);
  std::vector<double> steps;
  for (std::size_t k = 1; k < loops.size(); ++k)
    steps.push_back(
        std::abs((mean_of(loops[k]->points) - mean_of(loops[k - 1]->points)).dot(normal)));
  return median(std::move(steps));
}

Vec3 basal_slab(const Contours& contours) {
  const auto loops = loops_from_base(contours, Side::endo);
  const Frame plane = plane_of(loops.front()->points);
  const Vec3 normal = plane.axes.col(2);
  const Vec3 away = plane.origin - mean_of(loops.back()->points);
  return std::copysign(0.5 * slice_spacing(contours), normal.dot(away)) * normal;
}

double vanishing_depth(const Contours& contours, Side side) {
  const auto loops = loops_from_base(contours, side);
  if (loops.size() < 2)
    return slice_spacing(contours);
  const Contour& last = *loops[loops.size() - 1];
  const Contour& above = *loops[loops.size() - 2];
  const double spacing = std::abs(plane_of(last.points).to_model(mean_of(above.points)).z());
  const double r = mean_radius(last);
  const double r_above = mean_radius(above);
  if (r_above <= r)
    return std::numeric_limits<double>::infinity();
  return spacing * r * r / (r_above * r_above - r * r);
}

double extrapolated_depth(const Contours& contours, Side side) {
  const auto loops = loops_from_base(contours, side);
  if (loops.size() < 2)
    return slice_spacing(contours);
  const Vec3 above = mean_of(loops[loops.size() - 2]->points);
  const double spacing = std::abs(plane_of(loops.back()->points).to_model(above).z());
  return std::min(spacing, vanishing_depth(contours, side));
}

LongAxis long_axis(const Contours& contours) {
  const std::vector<Centre> centres = centres_of(contours);
  LongAxis even = line_through(centres, [](const Centre&) { return 1.0; });
  if (passes_within(even, contours))
    return even;
  return line_through(centres, [](const Centre& c) { return 1.0 / (c.radius * c.radius); });
}

Vec3 endo_apex(const Contours& contours) {
  const auto shown = apex_points(contours, Side::endo);
  if (!shown.empty())
    return mean_of(shown);
  const LongAxis axis = long_axis(contours);
  const Vec3 last = mean_of(loops_from_base(contours, Side::endo).back()->points);
  const double height = (last - axis.point).dot(axis.up) - extrapolated_depth(contours, Side::endo);
  return axis.point + height * axis.up;
}

Frame model_frame(const Contours& contours, const FrameParameters& parameters) {
  const Contour& basal = *loops_from_base(contours, Side::endo).front();
  const LongAxis axis = long_axis(contours);
  Frame frame;
  frame.origin = mean_of(basal.points);
  const Vec3 offset = base_offset(contours, frame.origin, parameters.base_at);
  Vec3 z = axis.up;
  if (parameters.base_plane == BasePlane::basal_slice) {
    z = plane_of(basal.points).axes.col(2);
    z *= std::copysign(1.0, z.dot(axis.up));
  } else {
    frame.origin = axis.point + (frame.origin - axis.point).dot(z) * z;
  }
  frame.origin += offset.dot(z) * z;
  const Vec3 x = x_direction(basal, frame.origin, z, parameters).normalized();
  frame.axes.col(0) = x;
  frame.axes.col(1) = z.cross(x);
  frame.axes.col(2) = z;
  return frame;
}

}  // namespace lv::geometry
