#include "lv/strain/track.hpp"

#include "lv/base/check.hpp"
#include "lv/base/processors.hpp"
#include "lv/base/time_left.hpp"
#include "lv/geometry/contour_measures.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::strain {
namespace {

using geometry::Contour;
using std::numbers::pi;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Points on the image in its own coordinates: columns and rows times spacing.
class InPlane {
 public:
  explicit InPlane(const image::Plane& plane) : plane_(plane) {}
  [[nodiscard]] Vec2 to(const Vec3& x) const {
    const Vec3 d = x - plane_.origin;
    return {d.dot(plane_.along_row), d.dot(plane_.along_column)};
  }
  [[nodiscard]] Vec3 from(const Vec2& u) const {
    return plane_.origin + u.x() * plane_.along_row + u.y() * plane_.along_column;
  }
  [[nodiscard]] double height(const Vec3& x) const { return plane_.pixel(x).z(); }

 private:
  const image::Plane& plane_;
};

std::vector<Vec2> on_image(const Contour& loop, const image::Plane& plane) {
  constexpr double farthest = 1.0;  // [mm]
  const InPlane in_plane(plane);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Vec3 pixel = plane.pixel(loop.points[i]);
    const bool inside = pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < plane.columns - 0.5 &&
                        pixel.y() < plane.rows - 0.5;
    if (!inside || std::abs(pixel.z()) > farthest)
      throw InputError(loop.where(i),
                       fmt::format("{}: a point lies {:.1f} mm from the plane of its image, at "
                                   "column {:.1f}, row {:.1f} of {} x {}",
                                   geometry::label(loop), pixel.z(), pixel.x(), pixel.y(),
                                   plane.columns, plane.rows),
                       "Give the contours that were drawn on these images");
    points.push_back(in_plane.to(loop.points[i]));
  }
  return points;
}

/// The centre of a polygon's area.
Vec2 centroid(const std::vector<Vec2>& polygon) {
  double area = 0.0;
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const double a = cross(polygon[j] - polygon[0], polygon[i] - polygon[0]);
    area += a;
    sum += a * (polygon[j] + polygon[i] + polygon[0]) / 3.0;
  }
  return sum / area;
}

/// Between the image's coordinates and the slice's frame (see ring.hpp).
struct SliceFrame {
  Vec2 origin;
  Mat2 axes;  ///< columns: towards the septum, towards the anterior wall, on the image

  [[nodiscard]] Vec2 to_image(const Vec2& x) const { return origin + axes * x; }
  [[nodiscard]] Vec2 from_image(const Vec2& u) const { return axes.transpose() * (u - origin); }
};

SliceFrame slice_frame(const image::Plane& plane, const Vec2& centre, const Orientation& o) {
  const Vec3 up = plane.normal() * (plane.normal().dot(o.up) < 0.0 ? -1.0 : 1.0);
  const InPlane in_plane(plane);
  const Vec2 septum = in_plane.to(o.septum) - centre;
  if (septum.norm() < 1.0)
    throw InputError("septum point", "lies in the middle of the cavity of a slice",
                     "Give a point of the middle of the septum");
  const Vec3 x = septum.x() * plane.along_row + septum.y() * plane.along_column;
  const Vec3 y = up.cross(x);
  SliceFrame frame{centre, {}};
  frame.axes.col(0) = septum.normalized();
  frame.axes.col(1) = Vec2(y.dot(plane.along_row), y.dot(plane.along_column)).normalized();
  return frame;
}

/// A loop as a distance from the origin at every angle.
class PolarLoop {
 public:
  PolarLoop(const std::vector<Vec2>& on_image, const SliceFrame& frame, const Contour& loop) {
    double turned = 0.0;
    std::vector<Vec2> points;
    for (const Vec2& u : on_image)
      points.push_back(frame.from_image(u));
    double least = pi;
    double most = -pi;
    for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
      const double turn = std::atan2(cross(points[j], points[i]), points[j].dot(points[i]));
      turned += turn;
      least = std::min(least, turn);
      most = std::max(most, turn);
    }
    constexpr double backwards = 0.05;  // of a hand that trembles
    const bool star = std::abs(std::abs(turned) - 2.0 * pi) < 1e-6 &&
                      (turned > 0.0 ? least > -backwards : most < backwards);
    if (!star)
      throw InputError(loop.where(),
                       fmt::format("{} does not run once around the middle of the cavity",
                                   geometry::label(loop)),
                       "Draw loops that every ray from the cavity's middle meets once");
    for (const Vec2& x : points)
      corners_.push_back({std::atan2(x.y(), x.x()), x});
    std::sort(corners_.begin(), corners_.end(),
              [](const Corner& a, const Corner& b) { return a.angle < b.angle; });
  }

  [[nodiscard]] double operator()(double angle) const {
    const double wrapped = std::remainder(angle, 2.0 * pi);
    const auto after = std::upper_bound(corners_.begin(), corners_.end(), wrapped,
                                        [](double a, const Corner& c) { return a < c.angle; });
    const Vec2& b = after == corners_.end() ? corners_.front().x : after->x;
    const Vec2& a = after == corners_.begin() ? corners_.back().x : std::prev(after)->x;
    const Vec2 out(std::cos(wrapped), std::sin(wrapped));
    const double slope = cross(out, b - a);
    return std::abs(slope) < 1e-12 ? a.norm() : cross(a, b - a) / slope;
  }

 private:
  struct Corner {
    double angle;
    Vec2 x;
  };
  std::vector<Corner> corners_;
};

/// Which third of the cavity's length a slice lies in.
int third_of(const image::Plane& plane, const Orientation& o) {
  const Vec3 centre = plane.middle();
  // where the axis from base to apex meets the plane
  const double base = (o.base - centre).dot(plane.normal());
  const double apex = (o.apex - centre).dot(plane.normal());
  return std::clamp(static_cast<int>(3.0 * base / (base - apex)), 0, 2);
}

Contour carried(const Contour& loop, const std::vector<Vec2>& points, const Tracker& tracker,
                const InPlane& in_plane) {
  Contour moved{loop.slice, loop.side, {}, loop.file, {}};
  for (const Vec2& u : points)
    moved.points.push_back(in_plane.from(tracker(u).x));
  return moved;
}

double smallest_determinant(const SliceWall& wall, const Deformation& motion) {
  constexpr int around = 60;
  constexpr int layers = 4;
  double least = 1.0;
  for (int k = 0; k < around; ++k)
    for (int l = 0; l <= layers; ++l) {
      const double angle = 2.0 * pi * k / around;
      const double R = wall.endo(angle) + (wall.epi(angle) - wall.endo(angle)) * l / layers;
      const Mat2 F = motion(R * Vec2(std::cos(angle), std::sin(angle))).F;
      least = std::min(least, F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0));
    }
  return least;
}

}  // namespace

double loop_area(const std::vector<Vec3>& loop) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
    sum += (loop[j] - loop[0]).cross(loop[i] - loop[0]);
  return 0.5 * sum.norm();
}

namespace {

/// `progress` is told of every image.
TrackedSlice track(const SliceTask& task, const Orientation& orientation,
                   const RegistrationParameters& parameters, Progress& progress) {
  const auto& frames = task.cine->frames;
  const image::Plane& plane = frames.at(task.drawn).plane;
  const InPlane in_plane(plane);
  const std::vector<Vec2> endo = on_image(task.endo, plane);
  const std::vector<Vec2> epi = on_image(task.epi, plane);
  const SliceFrame frame = slice_frame(plane, centroid(endo), orientation);
  const SliceWall wall{PolarLoop(endo, frame, task.endo), PolarLoop(epi, frame, task.epi)};
  Tracker tracker(frames[task.drawn], epi, parameters);
  const Deformation motion = [&](const Vec2& X) {
    const Moved on_image = tracker(frame.to_image(X));
    return Moved{frame.from_image(on_image.x), frame.axes.transpose() * on_image.F * frame.axes};
  };
  TrackedSlice result;
  result.series.slice = task.endo.slice;
  result.series.third = third_of(plane, orientation);
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const std::size_t k = (task.drawn + n) % frames.size();
    result.matches.push_back(n == 0 ? Match{} : tracker.follow(frames[k]));
    result.series.phases.push_back(task.phases.at(k));
    if (!task.cine->times.empty())
      result.series.times.push_back(task.cine->times[k]);
    result.series.motion.push_back(follow(wall, motion));
    result.endo.push_back(carried(task.endo, endo, tracker, in_plane));
    result.epi.push_back(carried(task.epi, epi, tracker, in_plane));
    result.cavity_areas.push_back(loop_area(result.endo.back().points));
    result.smallest_J = std::min(result.smallest_J, smallest_determinant(wall, motion));
    progress.add();
  }
  return result;
}

Progress progress_of(const std::vector<SliceTask>& tasks) {
  std::size_t images = 0;
  for (const SliceTask& task : tasks)
    images += task.cine->frames.size();
  return {"following the muscle", images};
}

}  // namespace

TrackedSlice track(const SliceTask& task, const Orientation& orientation,
                   const RegistrationParameters& parameters) {
  Progress progress = progress_of({task});
  return track(task, orientation, parameters, progress);
}

std::vector<TrackedSlice> track(const std::vector<SliceTask>& tasks, const Orientation& orientation,
                                const RegistrationParameters& parameters) {
  std::vector<TrackedSlice> results(tasks.size());
  Progress progress = progress_of(tasks);
  in_threads(tasks.size(), [&](std::size_t i) {
    results[i] = track(tasks[i], orientation, parameters, progress);
  });
  return results;
}

}  // namespace lv::strain
