#include "lv/segment/long_axis.hpp"

#include "lv/base/interrupt.hpp"
#include "lv/base/processors.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/long_axis.hpp"
#include "lv/strain/warp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::segment {
namespace {

strain::Vec2 in_picture(const image::Plane& plane, const Vec3& x) {
  const Vec3 d = x - plane.origin;
  return {d.dot(plane.along_row), d.dot(plane.along_column)};
}

/// A point where the registration has it now.
void follow_point(const strain::Tracker& tracker, const image::Plane& plane,
                  std::optional<FoundPoint>& point) {
  if (!point)
    return;
  const strain::Vec2 now = tracker(in_picture(plane, point->at)).x;
  point->at = plane.point(now.x() / plane.spacing_i, now.y() / plane.spacing_j);
}

/// The marks of one picture in all pictures of the view.
std::vector<LongAxisMarks> followed(const image::CineSlice& view, std::size_t first,
                                    const LongAxisMarks& marks, const std::vector<Vec3>& outline) {
  std::vector<LongAxisMarks> all(view.frames.size(), marks);
  const image::Plane& plane = view.frames[first].plane;
  std::vector<strain::Vec2> around;
  for (const Vec3& x : outline)
    around.push_back(in_picture(plane, x));
  strain::Tracker tracker(view.frames[first], around, {});
  for (std::size_t n = 1; n < view.frames.size(); ++n) {
    interrupt::check();
    const std::size_t k = (first + n) % view.frames.size();
    tracker.follow(view.frames[k]);
    for (auto& point : all[k].annulus)
      follow_point(tracker, plane, point);
    follow_point(tracker, plane, all[k].apex);
  }
  return all;
}

bool found_any(const LongAxisMarks& marks) {
  return marks.apex || marks.annulus[0] || marks.annulus[1];
}

std::vector<LongAxisMarks> marks_of(const image::Cine& cine, const Segmentation& found,
                                    const image::CineSlice& view) {
  const std::size_t frames = cine.slices.front().frames.size();
  const auto diastole = static_cast<std::size_t>(found.phases.end_diastole);
  const geometry::Contours loops = contours_at(cine, found, diastole);
  const std::size_t first = picture_of(view, diastole, frames);
  const LongAxisMarks marks = find_marks(view.frames[first], loops, {found.spacing, found.fall});
  if (!found_any(marks))
    return std::vector<LongAxisMarks>(frames);
  const auto all =
      followed(view, first, marks, outline_of_wall(view.frames[first].plane, loops, marks));
  std::vector<LongAxisMarks> by_frame;
  for (std::size_t t = 0; t < frames; ++t)
    by_frame.push_back(all[picture_of(view, t, frames)]);
  return by_frame;
}

bool is_sure(const std::optional<FoundPoint>& point) {
  return point && point->confidence >= doubtful;
}

/// The side of the patient to which a direction points most.
const char* words_of(const Vec3& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  constexpr std::array<std::array<const char*, 2>, 3> words{
      {{"left", "right"}, {"back", "front"}, {"head", "feet"}}};
  return words.at(axis).at(direction(axis) > 0.0 ? 0 : 1);
}

/// What is looked at for doubts: moments and the long axis.
struct EndsContext {
  std::size_t diastole, systole;
  geometry::LongAxis axis;
};

/// A wall's end that goes the wrong way is none.
void judge_motion(const EndsContext& of, std::vector<LongAxisMarks>& view) {
  constexpr double most = 1.0;  // away from the apex [mm]
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& before = view[of.diastole].annulus[side];
    const auto& after = view[of.systole].annulus[side];
    if (!before || (after->at - before->at).dot(of.axis.up) <= most)
      continue;
    for (LongAxisMarks& marks : view)
      marks.annulus[side]->confidence = 0.0;
  }
}

/// Sentences on one end of a view.
void doubt_end(const std::string& what, const std::optional<FoundPoint>& point,
               std::vector<std::string>& doubts) {
  if (!point)
    doubts.push_back(what + " is not found");
  else if (!is_sure(point))
    doubts.push_back(fmt::format("{} is doubtful (confidence {:.2f})", what, point->confidence));
}

void doubt_views(const EndsContext& of, const std::vector<image::CineSlice>& views,
                 LongAxisEnds& ends) {
  for (std::size_t v = 0; v < views.size(); ++v) {
    const LongAxisMarks& marks = ends.views[v][of.diastole];
    const std::string name = fmt::format("long axis {}", v + 1);
    if (!found_any(marks)) {
      ends.doubts.push_back(name +
                            " tells nothing: fewer than three slices cut it on both sides of the "
                            "axis, or its blood and muscle are not told apart");
      continue;
    }
    const Vec3 side = side_of(views[v].frames.front().plane, of.axis);
    for (std::size_t s = 0; s < 2; ++s)
      doubt_end(fmt::format("{}: the end of the wall towards the {}", name,
                            words_of(s == 0 ? Vec3(-side) : side)),
                marks.annulus[s], ends.doubts);
    doubt_end(name + ": the tip", marks.apex, ends.doubts);
  }
}

void doubt_tips(const EndsContext& of, LongAxisEnds& ends) {
  constexpr double apart = 5.0;  // [mm]
  const auto tip = apex_at(ends, of.diastole);
  for (std::size_t v = 0; tip && v < ends.views.size(); ++v)
    if (const auto& own = ends.views[v][of.diastole].apex;
        is_sure(own) && (own->at - tip->at).norm() > apart)
      ends.doubts.push_back(fmt::format("long axis {}: the tip lies {:.0f} mm from that of all",
                                        v + 1, (own->at - tip->at).norm()));
}

/// Slices whose cavity lies above the annulus, and what becomes of the base plane.
void doubt_base(const EndsContext& of, const geometry::Contours& loops, LongAxisEnds& ends) {
  const auto points = annulus_at(ends, of.diastole);
  if (points.empty()) {
    ends.doubts.emplace_back(
        "long axis images do not tell where the base is: it stays that of the most basal slice, by "
        "rule");
    return;
  }
  Vec3 middle = Vec3::Zero();
  for (const AnnulusPoint& point : points)
    middle += point.at / static_cast<double>(points.size());
  for (const geometry::Contour& loop : loops.short_axis) {
    const double above = (geometry::mean_of(loop.points) - middle).dot(of.axis.up);
    if (loop.side == geometry::Side::endo && above > 0.0)
      ends.doubts.push_back(
          fmt::format("slice {} lies {:.1f} mm above the annulus of the long axes: an atrium",
                      loop.slice, above));
  }
}

/// Slices without borders that the axis crosses between the tip and the annulus: a tip that
/// trabeculae fill, or a base that was taken for an atrium.
void doubt_unshown(const EndsContext& of, const image::Cine& cine, const Segmentation& found,
                   LongAxisEnds& ends) {
  constexpr double inside = 2.0;  // beyond either end, within its error [mm]
  const auto tip = apex_at(ends, of.diastole);
  const auto points = annulus_at(ends, of.diastole);
  if (!tip || points.empty())
    return;
  double base = 0.0;
  for (const AnnulusPoint& point : points)
    base += (point.at - tip->at).dot(of.axis.up) / static_cast<double>(points.size());
  for (std::size_t s = 0; s < cine.slices.size(); ++s) {
    const image::Plane& plane = cine.slices[s].frames.front().plane;
    const double above = -plane.pixel(tip->at).z() / plane.normal().dot(of.axis.up);
    if (found.shows[s][of.diastole] == 0 && above > inside && above < base - inside)
      ends.doubts.push_back(fmt::format(
          "slice {} has no border at end-diastole, but lies {:.1f} mm above the tip and {:.1f} mm "
          "below the annulus that the long axes show: draw it",
          s + 1, above, base - above));
  }
}

}  // namespace

std::size_t picture_of(const image::CineSlice& view, std::size_t frame, std::size_t frames) {
  const auto pictures = static_cast<double>(view.frames.size());
  return static_cast<std::size_t>(
             std::lround(static_cast<double>(frame) * pictures / static_cast<double>(frames))) %
         view.frames.size();
}

std::vector<AnnulusPoint> annulus_at(const LongAxisEnds& ends, std::size_t frame) {
  std::vector<AnnulusPoint> points;
  bool both = false;
  for (std::size_t v = 0; v < ends.views.size(); ++v) {
    const auto& annulus = ends.views[v][frame].annulus;
    both = both || (is_sure(annulus[0]) && is_sure(annulus[1]));
    for (std::size_t side = 0; side < 2; ++side)
      if (is_sure(annulus[side]))
        points.push_back({v, side, annulus[side]->at});
  }
  return both ? points : std::vector<AnnulusPoint>{};
}

std::optional<Tip> apex_at(const LongAxisEnds& ends, std::size_t frame) {
  Tip tip;
  double best = 0.0;
  int n = 0;
  for (std::size_t v = 0; v < ends.views.size(); ++v) {
    const auto& apex = ends.views[v][frame].apex;
    if (!is_sure(apex))
      continue;
    tip.at += apex->at;
    ++n;
    if (apex->confidence > best) {
      best = apex->confidence;
      tip.view = v;
    }
  }
  tip.at /= std::max(n, 1);
  return n == 0 ? std::nullopt : std::optional(tip);
}

LongAxisEnds find_ends(const image::Cine& cine, const Segmentation& found,
                       const std::vector<image::CineSlice>& views) {
  LongAxisEnds ends;
  ends.views.resize(views.size());
  if (views.empty())
    return ends;
  in_threads(views.size(), [&](std::size_t v) { ends.views[v] = marks_of(cine, found, views[v]); });
  const auto diastole = static_cast<std::size_t>(found.phases.end_diastole);
  const geometry::Contours loops = contours_at(cine, found, diastole);
  const EndsContext context{diastole, static_cast<std::size_t>(found.phases.end_systole),
                            geometry::long_axis(loops)};
  for (auto& view : ends.views)
    judge_motion(context, view);
  doubt_views(context, views, ends);
  doubt_tips(context, ends);
  doubt_base(context, loops, ends);
  doubt_unshown(context, cine, found, ends);
  return ends;
}

}  // namespace lv::segment
