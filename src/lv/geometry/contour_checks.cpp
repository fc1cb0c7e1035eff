#include "lv/geometry/contour_checks.hpp"

#include "lv/base/check.hpp"
#include "lv/base/median.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/long_axis.hpp"
#include "lv/geometry/polygon.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace lv::geometry {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr std::size_t least_loop_points = 8;
constexpr std::size_t least_curve_points = 5;
constexpr std::size_t least_slices = 3;
constexpr double least_diameter = 10.0;  // mean of the endocardial loops [mm]
constexpr double largest_diameter = 120.0;
constexpr double flatness = 0.5;       // of a loop: farthest point from its plane [mm]
constexpr double pair_flatness = 1.0;  // of endo and epi in one slice [mm]
constexpr double gap_ratio = 4.0;      // of a loop's closing segment to the usual one
constexpr double least_spacing = 1.0;  // of slices [mm]
constexpr double largest_tilt = 15.0;  // of a slice against the stack's mean [degrees]
constexpr double farthest = 200.0;     // of long-axis and apex points from the stack [mm]
constexpr double beside = 20.0;  // of a long-axis curve from the loops: a breath moves by less

std::string place(const Vec3& x) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", x.x(), x.y(), x.z());
}

Polygon project(const Contour& loop, const Frame& plane) {
  Polygon polygon;
  for (const Vec3& x : loop.points)
    polygon.emplace_back(plane.to_model(x).head<2>());
  return polygon;
}

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Where the segment p0 p1 meets q0 q1, if it does.
std::optional<Vec2> meeting_point(const Vec2& p0, const Vec2& p1, const Vec2& q0, const Vec2& q1) {
  const Vec2 p = p1 - p0;
  const Vec2 q = q1 - q0;
  const double det = cross(p, q);
  constexpr double parallel = 1e-9;  // sine: borders of pixels, turned in space, are nearly so
  if (std::abs(det) <= parallel * p.norm() * q.norm())
    return std::nullopt;
  const double s = cross(q0 - p0, q) / det;
  const double t = cross(q0 - p0, p) / det;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0)
    return std::nullopt;
  return p0 + s * p;
}

struct Crossing {
  std::size_t first, second;  ///< segments, by their first points
  Vec2 at;
};

std::optional<Crossing> self_crossing(const Polygon& loop) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i + 2 < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1)
        continue;  // neighbours
      if (const auto at = meeting_point(loop[i], loop[i + 1], loop[j], loop[(j + 1) % n]))
        return Crossing{i, j, *at};
    }
  return std::nullopt;
}

std::optional<Crossing> crossing(const Polygon& a, const Polygon& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (const auto at = meeting_point(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()]))
        return Crossing{i, j, *at};
  return std::nullopt;
}

/// How the endocardium lies to the epicardium of its slice.
enum class Pairing { inside, crossing, exchanged, beside };

Pairing pairing(const Polygon& inner, const Polygon& outer) {
  if (crossing(inner, outer))
    return Pairing::crossing;
  if (encloses(inner, outer.front()))
    return Pairing::exchanged;
  return encloses(outer, inner.front()) ? Pairing::inside : Pairing::beside;
}

void check_counts(const Contours& contours) {
  const auto check = [](const Contour& c, std::size_t least, const char* kind) {
    if (c.points.size() < least)
      throw InputError(c.where(),
                       fmt::format("{}: {} point{} in a {}; at least {} are needed", label(c),
                                   c.points.size(), c.points.size() == 1 ? "" : "s", kind, least),
                       "Draw the contour with more points or remove it");
  };
  if (contours.short_axis.empty())
    throw InputError("contours", "there is no short-axis contour", "Draw at least three slices");
  for (const Contour& c : contours.short_axis)
    check(c, least_loop_points, "short-axis loop");
  for (const Contour& c : contours.long_axis)
    check(c, least_curve_points, "long-axis curve");
}

/// Numbers so large that lengths could not be told from them.
void check_positions(const Contours& contours) {
  constexpr double largest = 1e12;  // whose squares and their sums still are numbers
  for (const auto* set : {&contours.short_axis, &contours.long_axis, &contours.apex})
    for (const Contour& c : *set)
      for (std::size_t i = 0; i < c.points.size(); ++i)
        if (!(c.points[i].cwiseAbs().maxCoeff() <= largest))
          throw InputError(c.where(i),
                           fmt::format("{}: the point {} is no place in a scanner", label(c),
                                       place(c.points[i])),
                           "Give positions in scanner millimetres");
}

/// The unit in which a length would be that of a ventricle.
std::string likely_unit(double diameter) {
  struct Unit {
    const char* name;
    double mm;
  };
  for (const Unit& unit : {Unit{"cm", 10.0}, Unit{"m", 1000.0}, Unit{"micrometres", 1e-3}})
    if (diameter * unit.mm >= least_diameter && diameter * unit.mm <= largest_diameter)
      return fmt::format("The numbers seem to be in {}: multiply them by {}", unit.name, unit.mm);
  return "No common unit explains it: check the positions";
}

/// The mean diameter of the loops of one side [mm]; none where there are none.
std::optional<double> mean_diameter(const Contours& contours, Side side) {
  double sum = 0.0;
  int loops = 0;
  for (const Contour& c : contours.short_axis) {
    if (c.side != side)
      continue;
    sum += 2.0 * mean_radius(c);
    ++loops;
  }
  return loops > 0 ? std::optional(sum / loops) : std::nullopt;
}

/// A cavity may be nearly empty at the end of systole; then the epicardium tells the unit.
void check_units(const Contours& contours) {
  const auto is_usual = [](double diameter) {
    return diameter >= least_diameter && diameter <= largest_diameter;
  };
  const double diameter =
      mean_diameter(contours, Side::endo).value_or(2.0 * mean_radius(contours.short_axis.front()));
  const double outer = mean_diameter(contours, Side::epi).value_or(diameter);
  if (!is_usual(diameter) && !is_usual(outer))
    throw InputError(contours.short_axis.front().where(),
                     fmt::format("the mean diameter of the endocardium is {:.3g} mm; a ventricle's "
                                 "lies between {:g} and {:g} mm",
                                 diameter, least_diameter, largest_diameter),
                     likely_unit(diameter));
}

[[noreturn]] void fail_flat(const Contour& loop, std::size_t i, double height, double tolerance,
                            const char* remedy) {
  throw InputError(
      loop.where(i),
      fmt::format(
          "{}: the point {} lies {:.2f} mm out of the slice's plane; at most {:g} mm is accepted",
          label(loop), place(loop.points[i]), height, tolerance),
      remedy);
}

void check_flat(const Contour& loop, const Frame& plane, double tolerance, const char* remedy) {
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const double height = plane.to_model(loop.points[i]).z();
    if (std::abs(height) > tolerance)
      fail_flat(loop, i, std::abs(height), tolerance, remedy);
  }
}

/// A point, and its distance from the plane of the others [mm].
struct Stray {
  std::size_t point = 0;
  double height = 0.0;
};

/// The point without which the others are flattest: one that is far off tilts the plane of all, out
/// of which others then seem to lie.
Stray stray_of(const Contour& loop) {
  Stray stray;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    std::vector<Vec3> others = loop.points;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Frame plane = plane_of(others);
    double sum = 0.0;
    for (const Vec3& x : others)
      sum += std::pow(plane.to_model(x).z(), 2);
    if (sum < least) {
      least = sum;
      stray = {i, std::abs(plane.to_model(loop.points[i]).z())};
    }
  }
  return stray;
}

void check_own_plane(const Contour& loop, const Frame& plane) {
  const char* remedy = "A short-axis loop is drawn on one image: check the point";
  const bool flat = std::all_of(loop.points.begin(), loop.points.end(), [&](const Vec3& x) {
    return std::abs(plane.to_model(x).z()) <= flatness;
  });
  if (flat)
    return;
  if (const Stray stray = stray_of(loop); stray.height > flatness)
    fail_flat(loop, stray.point, stray.height, flatness, remedy);
  check_flat(loop, plane, flatness, remedy);
}

void check_closed(const Contour& loop) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < loop.points.size(); ++i)
    steps.push_back((loop.points[i] - loop.points[i - 1]).norm());
  const double usual = median(std::move(steps));
  const double gap = (loop.points.back() - loop.points.front()).norm();
  if (gap > gap_ratio * usual)
    throw InputError(
        loop.where(loop.points.size() - 1),
        fmt::format("{}: the loop is open: its ends {} and {} are {:.1f} mm apart where "
                    "neighbouring points are {:.1f} mm apart",
                    label(loop), place(loop.points.front()), place(loop.points.back()), gap, usual),
        "Draw the loop all the way round");
}

void check_simple(const Contour& loop, const Frame& plane) {
  if (const auto c = self_crossing(project(loop, plane)))
    throw InputError(loop.where(c->first),
                     fmt::format("{}: the loop crosses itself at {}, after its points {} and {}",
                                 label(loop), place(plane.to_image({c->at.x(), c->at.y(), 0.0})),
                                 c->first + 1, c->second + 1),
                     "Put the points in order along the border or redraw it there");
}

/// The endocardium must lie inside the epicardium of its slice.
void check_pair(const Contour& endo, const Contour& epi) {
  const Frame plane = plane_of(endo.points);
  check_flat(epi, plane, pair_flatness,
             "Both borders of a slice lie on one image: check the slice numbers");
  const Polygon inner = project(endo, plane);
  const Polygon outer = project(epi, plane);
  switch (pairing(inner, outer)) {
    case Pairing::crossing: {
      const Crossing c = *crossing(inner, outer);
      throw InputError(
          endo.where(c.first),
          fmt::format("slice {}: the endocardium crosses the epicardium ({}) at {}", endo.slice,
                      epi.where(c.second), place(plane.to_image({c.at.x(), c.at.y(), 0.0}))),
          "Redraw the borders there: the wall lies between them");
    }
    case Pairing::exchanged:
      throw InputError(endo.where(),
                       fmt::format("slice {}: the endo loop encloses the epi loop ({})", endo.slice,
                                   epi.where()),
                       "The names seem swapped: endo is the inner border, epi the outer one");
    case Pairing::beside:
      throw InputError(endo.where(),
                       fmt::format("slice {}: the endo loop lies beside the epi loop ({})",
                                   endo.slice, epi.where()),
                       "Check that both borders belong to the same slice and image");
    case Pairing::inside:
      return;
  }
}

const char* in_words(Pairing pairing) {
  switch (pairing) {
    case Pairing::crossing:
      return "the endocardium crosses the epicardium";
    case Pairing::exchanged:
      return "the endocardium encloses the epicardium, as if they were exchanged";
    case Pairing::beside:
      return "the endocardium lies beside the epicardium";
    case Pairing::inside:
      break;
  }
  return "";
}

void check_slices(const Contours& contours) {
  for (const Contour& c : contours.short_axis) {
    const Contour* endo = find(contours.short_axis, c.slice, Side::endo);
    if (c.side == Side::epi && endo != nullptr)
      check_pair(*endo, c);
  }
}

/// A slice without endocardium can only lie beyond the cavity's apex.
void check_lone_epicardium(const Contours& contours) {
  const auto endo = loops_from_base(contours, Side::endo);
  const Vec3 last = mean_of(endo.back()->points);
  const Vec3 down = last - mean_of(endo.front()->points);
  for (const Contour& c : contours.short_axis)
    if (find(contours.short_axis, c.slice, Side::endo) == nullptr &&
        (mean_of(c.points) - last).dot(down) <= 0.0)
      throw InputError(c.where(), fmt::format("slice {} has no endocardium", c.slice),
                       "Draw its endo loop or remove the slice");
}

/// One loop says nothing of how the wall changes along the axis.
void check_enough_epicardium(const Contours& contours) {
  const auto loops = loops_from_base(contours, Side::epi);
  const bool along = std::any_of(contours.long_axis.begin(), contours.long_axis.end(),
                                 [](const Contour& c) { return c.side == Side::epi; });
  if (loops.size() == 1 && !along)
    throw InputError(loops.front()->where(),
                     fmt::format("only slice {} has an epicardium; at least two are needed",
                                 loops.front()->slice),
                     "Draw the outer border of the muscle on more slices");
}

/// The endocardial loops in slice order with the planes they lie in, normals all to one side.
struct Stack {
  std::vector<const Contour*> loops;
  std::vector<Frame> planes;
  Vec3 normal = Vec3::Zero();  ///< mean of the planes'
};

Stack stack_of(const Contours& contours) {
  Stack stack;
  for (const Contour& c : contours.short_axis) {
    if (c.side != Side::endo)
      continue;
    Frame plane = plane_of(c.points);
    if (!stack.planes.empty() && plane.axes.col(2).dot(stack.planes.front().axes.col(2)) < 0.0)
      plane.axes.rightCols<2>() *= -1.0;
    stack.loops.push_back(&c);
    stack.planes.push_back(plane);
    stack.normal += plane.axes.col(2);
  }
  stack.normal.normalize();
  return stack;
}

void check_parallel(const Stack& stack) {
  for (std::size_t i = 0; i < stack.loops.size(); ++i) {
    const double cosine = std::min(1.0, stack.planes[i].axes.col(2).dot(stack.normal));
    const double tilt = std::acos(cosine) * 180.0 / std::numbers::pi;
    if (tilt > largest_tilt)
      throw InputError(stack.loops[i]->where(),
                       fmt::format("slice {} is tilted by {:.0f} degrees against the mean of the "
                                   "slices; at most {:g} are accepted",
                                   stack.loops[i]->slice, tilt, largest_tilt),
                       "Short-axis slices are parallel: check the positions of this one");
  }
}

void check_distinct(const Stack& stack) {
  for (std::size_t i = 0; i < stack.loops.size(); ++i)
    for (std::size_t j = i + 1; j < stack.loops.size(); ++j) {
      const double distance =
          std::abs((stack.planes[j].origin - stack.planes[i].origin).dot(stack.normal));
      if (distance < least_spacing)
        throw InputError(stack.loops[j]->where(),
                         fmt::format("slices {} and {} lie in the same plane ({:.2f} mm apart)",
                                     stack.loops[i]->slice, stack.loops[j]->slice, distance),
                         "Keep one of them, or check the positions");
    }
}

void check_order(const Stack& stack) {
  for (std::size_t i = 2; i < stack.loops.size(); ++i) {
    const auto step = [&](std::size_t k) {
      return (stack.planes[k].origin - stack.planes[k - 1].origin).dot(stack.normal);
    };
    if (step(i - 1) * step(i) < 0.0)
      throw InputError(stack.loops[i]->where(),
                       fmt::format("slice {} does not follow slices {} and {}: it lies {:.1f} mm "
                                   "back towards the first of them",
                                   stack.loops[i]->slice, stack.loops[i - 2]->slice,
                                   stack.loops[i - 1]->slice, std::abs(step(i))),
                       "Number the slices in order from one end of the ventricle to the other");
  }
}

/// No loop may reach through the plane of its neighbour.
void check_apart(const Stack& stack) {
  for (std::size_t i = 1; i < stack.loops.size(); ++i) {
    const Frame& below = stack.planes[i - 1];
    const double side = below.to_model(stack.planes[i].origin).z();
    for (std::size_t p = 0; p < stack.loops[i]->points.size(); ++p)
      if (below.to_model(stack.loops[i]->points[p]).z() * side <= 0.0)
        throw InputError(
            stack.loops[i]->where(p),
            fmt::format("slices {} and {} cross each other at {}", stack.loops[i - 1]->slice,
                        stack.loops[i]->slice, place(stack.loops[i]->points[p])),
            "Short-axis slices are parallel: check the positions of both");
  }
}

void check_nearby(const Contours& contours, const Stack& stack) {
  Vec3 middle = Vec3::Zero();
  for (const Frame& plane : stack.planes)
    middle += plane.origin / static_cast<double>(stack.planes.size());
  for (const auto* set : {&contours.long_axis, &contours.apex})
    for (const Contour& c : *set)
      for (std::size_t i = 0; i < c.points.size(); ++i)
        if ((c.points[i] - middle).norm() > farthest)
          throw InputError(c.where(i),
                           fmt::format("{}: the point {} lies {:.0f} mm from the short-axis slices",
                                       label(c), place(c.points[i]), (c.points[i] - middle).norm()),
                           "All contours share the scanner's coordinates in mm");
}

/// The distance of a point from a closed line [mm].
double distance_to(const Contour& loop, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Vec3& a = loop.points[i];
    const Vec3 along = loop.points[(i + 1) % loop.points.size()] - a;
    const double length2 = std::max(along.squaredNorm(), std::numeric_limits<double>::min());
    const double part = std::clamp((x - a).dot(along) / length2, 0.0, 1.0);
    least = std::min(least, (a + part * along - x).norm());
  }
  return least;
}

/// How far from the loops of its side a curve passes through their planes; of a curve that passes
/// through none, how far its nearest point lies from them [mm].
std::vector<double> distances_from(const Contours& contours, const Contour& curve) {
  std::vector<double> crossings;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Contour& loop : contours.short_axis) {
    if (loop.side != curve.side)
      continue;
    const Frame plane = plane_of(loop.points);
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      nearest = std::min(nearest, distance_to(loop, curve.points[i]));
      const double z = plane.to_model(curve.points[i]).z();
      const double before = i == 0 ? z : plane.to_model(curve.points[i - 1]).z();
      if (z * before >= 0.0)
        continue;
      const double part = before / (before - z);
      crossings.push_back(
          distance_to(loop, curve.points[i - 1] + part * (curve.points[i] - curve.points[i - 1])));
    }
  }
  return crossings.empty() ? std::vector{nearest} : crossings;
}

/// Long-axis curves and short-axis loops show one heart in one scanner.
void check_curves_meet(const Contours& contours) {
  for (const Contour& curve : contours.long_axis) {
    const std::vector<double> all = distances_from(contours, curve);
    const double usual = median(all);
    if (std::isfinite(usual) && usual > beside)
      throw InputError(
          curve.where(),
          fmt::format("{}: the long-axis curve passes the short-axis loops {:.0f} mm beside them "
                      "(median, of {:.0f} to {:.0f} mm); at most {:g} mm are accepted",
                      label(curve), usual, *std::min_element(all.begin(), all.end()),
                      *std::max_element(all.begin(), all.end()), beside),
          "All contours share the scanner's coordinates, LPS in mm: those of one file seem to be "
          "mirrored, turned (RAS) or of another heart");
  }
}

/// A curve on a long-axis image runs from the base over the apex to the base: its ends are apart.
void check_open(const Contour& curve) {
  double length = 0.0;
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    length += (curve.points[i] - curve.points[i - 1]).norm();
  const double gap = (curve.points.back() - curve.points.front()).norm();
  constexpr double least = 0.05;  // of its length; a ventricle's base is a fifth and more
  if (gap < least * length)
    throw InputError(curve.where(),
                     fmt::format("{}: the long-axis curve is closed: its ends are {:.1f} mm apart",
                                 label(curve), gap),
                     "Draw it open, from the base over the apex to the base");
}

}  // namespace

void check_contours(const Contours& contours) {
  check_counts(contours);
  check_positions(contours);
  check_units(contours);
  for (const Contour& loop : contours.short_axis) {
    const Frame plane = plane_of(loop.points);
    check_own_plane(loop, plane);
    check_closed(loop);
    check_simple(loop, plane);
  }
  for (const Contour& curve : contours.long_axis)
    check_open(curve);
  check_slices(contours);
  const Stack stack = stack_of(contours);
  if (stack.loops.size() < least_slices)
    throw InputError(
        contours.short_axis.front().where(),
        fmt::format("{} short-axis slice{}; at least {} are needed", stack.loops.size(),
                    stack.loops.size() == 1 ? "" : "s", least_slices),
        "Draw more slices between base and apex");
  check_parallel(stack);
  check_distinct(stack);
  check_order(stack);
  check_apart(stack);
  check_nearby(contours, stack);
  check_curves_meet(contours);
  check_lone_epicardium(contours);
  check_enough_epicardium(contours);
}

std::vector<SliceFault> slice_faults(const std::vector<Contour>& loops) {
  std::vector<SliceFault> faults;
  for (const Contour& loop : loops) {
    const Frame plane = plane_of(loop.points);
    const Polygon polygon = project(loop, plane);
    if (self_crossing(polygon))
      faults.push_back({loop.slice, loop.side == Side::endo ? "the endocardium crosses itself"
                                                            : "the epicardium crosses itself"});
    const Contour* epi = find(loops, loop.slice, Side::epi);
    if (loop.side != Side::endo || epi == nullptr)
      continue;
    if (const Pairing is = pairing(polygon, project(*epi, plane)); is != Pairing::inside)
      faults.push_back({loop.slice, in_words(is)});
  }
  return faults;
}

std::vector<std::string> notes_on_spacing(const Contours& contours) {
  constexpr double wide = 1.5;            // of the usual step
  constexpr double uneven = 0.3;          // by which the steps beside a misplaced slice are off
  constexpr double two_steps = 0.1;       // relative: of a slice between its neighbours
  constexpr std::size_t least_known = 3;  // steps that tell what is usual beside two wrong ones
  std::vector<std::pair<Vec3, int>> slices;
  for (const Contour& loop : contours.short_axis)
    if (loop.side == Side::endo && !loop.points.empty())
      slices.emplace_back(mean_of(loop.points), loop.slice);
  if (slices.size() < 3)
    return {};
  const Vec3 axis = (slices.back().first - slices.front().first).normalized();
  std::vector<double> steps;
  for (std::size_t i = 1; i < slices.size(); ++i)
    steps.push_back(std::abs(axis.dot(slices[i].first - slices[i - 1].first)));
  std::vector<double> sorted = steps;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[(sorted.size() - 1) / 2];  // the lower of two
  const auto misplaced = [&](std::size_t i) {            // between the steps i and i + 1
    return i + 1 < steps.size() && steps.size() >= least_known &&
           std::max(steps[i], steps[i + 1]) > (1.0 + uneven) * usual &&
           std::min(steps[i], steps[i + 1]) < (1.0 - uneven) * usual &&
           std::abs(steps[i] + steps[i + 1] - 2.0 * usual) < two_steps * 2.0 * usual;
  };
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (misplaced(i)) {
      notes.push_back(
          fmt::format("slice {} lies {:.1f} mm from slice {} and {:.1f} mm from slice {}, where "
                      "others lie {:.1f} mm apart: it seems misplaced; check its position",
                      slices[i + 1].second, steps[i], slices[i].second, steps[i + 1],
                      slices[i + 2].second, usual));
      ++i;  // both steps are told
    } else if (steps[i] > wide * usual) {
      notes.push_back(
          fmt::format("slices {} and {} lie {:.1f} mm apart, others {:.1f} mm: the wall between "
                      "them is interpolated; if slices are missing, draw them",
                      slices[i].second, slices[i + 1].second, steps[i], usual));
    }
  }
  return notes;
}

std::string hidden_tip(const Contours& contours) {
  const auto endo = loops_from_base(contours, Side::endo);
  const bool ends_above = std::any_of(
      contours.short_axis.begin(), contours.short_axis.end(),
      [&](const Contour& c) { return find(contours.short_axis, c.slice, Side::endo) == nullptr; });
  if (endo.empty() || ends_above || shows_apex(contours, Side::endo))
    return "";
  double largest = 0.0;
  for (const Contour* loop : endo)
    largest = std::max(largest, enclosed_area(*loop));
  const double last = enclosed_area(*endo.back());
  if (last <= largest_tip * largest)
    return "";
  return fmt::format(
      "slice {} is the last towards the tip, and its cavity has {:.0f}% of the largest slice's "
      "area: the tip is not shown but made up from the slices there are, and volumes and mass lack "
      "what lies beyond; give the slices down to the tip, or a point of it",
      endo.back()->slice, 100.0 * last / largest);
}

std::vector<std::string> notes_on_gaps(const Contours& contours) {
  constexpr double wide = 0.2;  // of a loop's length
  constexpr double rare = 5.0;  // times the usual step between its points
  std::vector<std::string> gaps;
  double widest = 0.0;
  for (const Contour& loop : contours.short_axis) {
    std::vector<double> steps;
    for (std::size_t i = 0; i < loop.points.size(); ++i)
      steps.push_back((loop.points[(i + 1) % loop.points.size()] - loop.points[i]).norm());
    const double length = std::accumulate(steps.begin(), steps.end(), 0.0);
    const double largest = *std::max_element(steps.begin(), steps.end());
    if (largest < wide * length || largest < rare * median(steps))
      continue;
    gaps.push_back(fmt::format("slice {} {} ({:.1f} mm)", loop.slice, name(loop.side), largest));
    widest = std::max(widest, largest / length);
  }
  if (gaps.empty())
    return {};
  return {fmt::format(
      "up to {:.0f}% of a loop's length is without points, and bridged: {}; draw what is missing",
      100.0 * widest, fmt::join(gaps, ", "))};
}

}  // namespace lv::geometry
