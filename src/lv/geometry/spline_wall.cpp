#include "lv/geometry/spline_wall.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/long_axis.hpp"
#include "lv/geometry/surface_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace lv::geometry {
namespace {

using std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double thinnest_apex = 0.5;  // of the wall as the last slice shows it

/// "z = -12.3 mm, angle 45 degrees" of a point in the model frame.
std::string place_on_wall(const Vec3& x) {
  const double angle = std::atan2(x.y(), x.x()) * 180.0 / pi;
  const double z = std::round(10.0 * x.z()) / 10.0 + 0.0;  // never "-0.0"
  return fmt::format("z = {:.1f} mm, angle {:.0f} degrees", z, angle < 0.0 ? angle + 360.0 : angle);
}

void assume(const char* part, std::string text, FitReport& said) {
  said.notes.push_back(text);
  said.assumed.push_back({part, std::move(text)});
}

/// Collects the points of the contours for the fit.
class Sampler {
 public:
  Sampler(const Contours& contours, const Frame& frame, const SplineFitParameters& parameters)
      : contours_(contours), frame_(frame), slices_(slices_from_base(contours)) {
    for (const Contour& c : contours.short_axis)
      add_curve(c, true, infinity);
    if (parameters.frame.base_at == BaseAt::slab)
      add_end_of_slab();
    for (const Contour& c : contours.long_axis)
      add_curve(c, false, parameters.margin);
    for (const Contour& c : contours.apex)
      add_apex(c.side, frame.to_model(c.points.front()));
    if (samples(Side::epi).empty())
      throw InputError(contours.short_axis.front().where(), "no slice has an epicardium",
                       "Draw the epi loops: the wall lies between endo and epi");
  }

  /// The apexes that no contour shows, with a note on each.
  void add_assumed_apexes(FitReport& notes) {
    const Vec3 endo = frame_.to_model(endo_apex(contours_));
    if (!shows_apex(contours_, Side::endo)) {
      add_apex(Side::endo, endo);
      assume("apex",
             fmt::format(
                 "no contour shows the endocardial apex: assumed {:.1f} mm beyond the last slice",
                 extrapolated_depth(contours_, Side::endo)),
             notes);
    }
    if (!shows_apex(contours_, Side::epi))
      add_assumed_epi_apex(endo, notes);
  }

  [[nodiscard]] FitData data() const { return {samples_, {}}; }

  /// The same, with slices that may move.
  [[nodiscard]] FitData movable_data() const {
    FitData data{samples_, {}};
    for (const int slice : slices_) {
      Frame plane = plane_of(find(contours_.short_axis, slice, Side::endo)->points);
      plane.axes = frame_.axes.transpose() * plane.axes;
      plane.origin = frame_.to_model(plane.origin);
      data.planes.push_back(plane);
    }
    return data;
  }

 private:
  std::vector<Sample>& samples(Side side) { return samples_[side == Side::endo ? 0 : 1]; }

  void add_curve(const Contour& c, bool closed, double highest) {
    const auto length = point_lengths(c, closed);
    const auto found = std::find(slices_.begin(), slices_.end(), c.slice);
    const int index = found == slices_.end() ? -1 : static_cast<int>(found - slices_.begin());
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      const Vec3 x = frame_.to_model(c.points[i]);
      if (x.z() > highest)
        continue;
      if (closed)
        samples(c.side).push_back({x, length[i], Source::short_axis, index});
      else
        samples(c.side).push_back({x, length[i], Source::long_axis});
    }
  }

  /// The basal slice stands for a slab of tissue: its loops again, where the slab ends.
  void add_end_of_slab() {
    const Vec3 shift = frame_.axes.transpose() * basal_slab(contours_);
    for (const Side side : {Side::endo, Side::epi})
      if (const Contour* loop = find(contours_.short_axis, slices_.front(), side)) {
        const auto length = point_lengths(*loop, true);
        for (std::size_t i = 0; i < loop->points.size(); ++i)
          samples(side).push_back(
              {frame_.to_model(loop->points[i]) + shift, length[i], Source::short_axis, 0});
      }
  }

  /// Where the epicardium's last loops lead. In its plane a slice cuts the wall near the tip
  /// askew: what is seen there is the most that the wall is thick, unless muscle without a cavity
  /// shows more.
  void add_assumed_epi_apex(const Vec3& endo, FitReport& notes) {
    const double seen = apical_thickness();
    const Contour& last = *loops_from_base(contours_, Side::epi).back();
    const bool lone = find(contours_.short_axis, last.slice, Side::endo) == nullptr;
    // who draws no muscle alone may leave slices out that show it
    const double depth =
        lone ? extrapolated_depth(contours_, Side::epi) : vanishing_depth(contours_, Side::epi);
    const double height = frame_.to_model(mean_of(last.points)).z() - depth;
    if (lone && height < endo.z() - seen) {
      add_apex(Side::epi, Vec3(endo.x(), endo.y(), height));
      assume("apex",
             fmt::format("no contour shows the epicardial apex: assumed {:.1f} mm beyond slice {}, "
                         "the last with muscle",
                         depth, last.slice),
             notes);
      return;
    }
    const double thickness = std::clamp(endo.z() - height, thinnest_apex * seen, seen);
    add_apex(Side::epi, endo - Vec3(0.0, 0.0, thickness));
    const char* reason = thickness == seen ? "as thick as the wall of the last slice"
                         : thickness == thinnest_apex * seen
                             ? "half as thick as the wall of the last slice"
                             : "where its last loops lead";
    assume(
        "apex",
        fmt::format(
            "no contour shows the epicardial apex: assumed {:.1f} mm below the endocardial one, {}",
            thickness, reason),
        notes);
  }

  /// Its length is the others' mean.
  void add_apex(Side side, const Vec3& x) {
    double sum = 0.0;
    for (const Sample& p : samples(side))
      sum += p.length;
    const auto n = static_cast<double>(samples(side).size());
    samples(side).push_back({x, n > 0.0 ? sum / n : 1.0, Source::apex});
  }

  /// Mean thickness of the most apical slice that shows both borders, in its plane.
  [[nodiscard]] double apical_thickness() const {
    // NOLINTNEXTLINE(modernize-loop-convert): clang 14 cannot read std::views::reverse
    for (auto slice = slices_.rbegin(); slice != slices_.rend(); ++slice)
      if (const Contour* epi = find(contours_.short_axis, *slice, Side::epi))
        return mean_radius(*epi) - mean_radius(*find(contours_.short_axis, *slice, Side::endo));
    return 0.0;
  }

  const Contours& contours_;
  const Frame& frame_;
  std::vector<int> slices_;  ///< from the base to the apex
  std::array<std::vector<Sample>, 2> samples_;
};

/// Whether curves on two or more images show where the slices belong.
bool shown_by_long_axes(const Contours& contours) {
  std::set<int> images;
  for (const Contour& c : contours.long_axis)
    images.insert(c.slice);
  return images.size() >= 2;
}

Contours moved(Contours contours, const std::vector<Vec3>& shifts) {
  const std::vector<int> slices = slices_from_base(contours);
  for (Contour& c : contours.short_axis) {
    const auto found = std::find(slices.begin(), slices.end(), c.slice);
    if (found != slices.end())  // an epicardium beyond the cavity has no plane to move in
      for (Vec3& x : c.points)
        x += shifts[found - slices.begin()];
  }
  return contours;
}

/// By how much each side of a loop turns about the long axis [rad].
std::vector<double> turns_of(const Contour& loop, const Frame& frame) {
  const std::size_t n = loop.points.size();
  std::vector<double> turns(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = frame.to_model(loop.points[i]);
    const Vec3 q = frame.to_model(loop.points[(i + 1) % n]);
    turns[i] = std::atan2(p.x() * q.y() - p.y() * q.x(), p.x() * q.x() + p.y() * q.y());
  }
  return turns;
}

/// The long axis passes through a loop that turns about it once.
bool is_passed(double turn) {
  return std::abs(turn) >= pi;
}

double whole_turn(const std::vector<double>& turns) {
  return std::accumulate(turns.begin(), turns.end(), 0.0);
}

/// Where slices may move, a tip that shows muscle alone cannot: it has no cavity. Beside the long
/// axis it lies where a breath-hold put it, and is left out.
Contours without_stray_tips(Contours contours, const FrameParameters& parameters,
                            std::vector<std::string>& notes) {
  const Frame frame = model_frame(contours, parameters);
  const Contours all = contours;
  std::erase_if(contours.short_axis, [&](const Contour& c) {
    const bool stray = find(all.short_axis, c.slice, Side::endo) == nullptr &&
                       !is_passed(whole_turn(turns_of(c, frame)));
    if (stray)
      notes.push_back(fmt::format(
          "slice {} shows muscle without a cavity beside the long axis: left out", c.slice));
    return stray;
  });
  return contours;
}

/// Refuses a loop that the rays from the long axis do not meet, or meet more than once.
void check_star_shaped(const Contour& loop, const Frame& frame) {
  constexpr double tolerance = 10.0 * pi / 180.0;  // a small notch is smoothed away
  const std::vector<double> turns = turns_of(loop, frame);
  const std::size_t n = turns.size();
  const double total = whole_turn(turns);
  if (!is_passed(total))
    throw InputError(loop.where(), label(loop) + ": the long axis does not pass through the loop",
                     "The slice seems shifted against the others: check its position and the apex "
                     "points, or give long-axis contours to correct it");
  double back = 0.0;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    back = std::max(0.0, back - std::copysign(1.0, total) * turns[i % n]);
    if (back > tolerance)
      throw InputError(loop.where(i % n),
                       fmt::format("{}: the loop is folded as seen from the long axis, at {}",
                                   label(loop), place_on_wall(frame.to_model(loop.points[i % n]))),
                       "Leave papillary muscles and trabeculae out of the border there");
  }
}

void check_surfaces(const Contours& contours, const FittedSurfaces& fit) {
  for (const Side side : {Side::endo, Side::epi})
    if (!(side == Side::endo ? fit.endo : fit.epi).is_sound())
      throw InputError(
          contours.short_axis.front().where(),
          fmt::format(
              "no smooth {} surface fits the contours: it folds or does not reach the base plane",
              name(side)),
          "Check the contours near the base, or smooth more (smoothing length)");
}

void check_wall(const Contours& contours, const Frame& frame, const Thickness& thinnest,
                double least) {
  if (thinnest.value >= least)
    return;
  const Contour& loop = *find(contours.short_axis, thinnest.slice, Side::endo);
  const Contour& last = *loops_from_base(contours, Side::endo).back();
  const bool is_beyond = thinnest.at.z() < frame.to_model(mean_of(last.points)).z();
  const std::string at =
      is_beyond ? fmt::format(
                      "{}, beyond slice {}, the last with a cavity, where the wall is assumed from "
                      "the slices above",
                      place_on_wall(thinnest.at), last.slice)
                : fmt::format("{}, near slice {}", place_on_wall(thinnest.at), thinnest.slice);
  if (thinnest.value <= 0.0)
    throw InputError(
        loop.where(),
        fmt::format("the fitted endocardium lies {:.1f} mm outside the epicardium at {}",
                    -thinnest.value, at),
        "Redraw the borders there");
  throw InputError(
      loop.where(),
      fmt::format("the wall is only {:.1f} mm thick at {}; at least {:g} mm are needed",
                  thinnest.value, at, least),
      fmt::format("{}, or accept a thinner wall (anatomy.contours.thinnest_wall)",
                  is_beyond ? "Show where cavity and muscle end there, by points of the apex or "
                              "long-axis contours"
                            : "Redraw the borders there"));
}

/// The first place of a fine lattice where the wall (nearly) turns inside out: where
/// det[dx/dt dx/dtheta dx/du] is less than a twentieth of the product of these lengths. None if the
/// wall is sound.
std::optional<Vec3> inside_out(const SplineWall& wall) {
  constexpr int along = 32;
  constexpr int around = 48;
  constexpr int across = 2;
  constexpr double least = 0.05;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) {
      const auto line = [&](int up, int on) -> std::pair<Vec3, Vec3> {
        const double u = static_cast<double>(i + up) / along;
        const double theta = 2.0 * pi * (j + on) / around;
        return {wall.point(u, theta, 0.0), wall.point(u, theta, 1.0)};
      };
      const std::array lines{line(0, 0), line(0, 1), line(1, 0), line(1, 1)};
      for (int k = 0; k <= across; ++k) {
        const double t = static_cast<double>(k) / across;
        const auto at = [&](int n) {
          return Vec3((1.0 - t) * lines[n].first + t * lines[n].second);
        };
        Mat3 map;
        map.col(0) = Vec3::Zero();
        for (const auto& [inner, outer] : lines)
          map.col(0) += outer - inner;
        map.col(1) = at(1) + at(3) - at(0) - at(2);
        map.col(2) = at(2) + at(3) - at(0) - at(1);
        if (!(map.colwise().normalized().determinant() > least))
          return 0.25 * (at(0) + at(1) + at(2) + at(3));
      }
    }
  return std::nullopt;
}

void check_inside_out(const Contours& contours, const SplineWall& wall) {
  if (const auto at = inside_out(wall))
    throw InputError(contours.short_axis.front().where(),
                     fmt::format("the fitted wall turns inside out at {}: the lines across it meet",
                                 place_on_wall(*at)),
                     "Check the slices next to that place against their neighbours, and the apex: "
                     "points of it, or long-axis contours, show where it is");
}

void note_missing_epicardium(const Contours& contours, std::vector<std::string>& notes) {
  const std::vector<int> slices = slices_from_base(contours);
  const auto is_open = [&](int slice) {
    return find(contours.short_axis, slice, Side::epi) == nullptr;
  };
  const auto open = std::count_if(slices.begin(), slices.end(), is_open);
  if (open + 1 >= static_cast<std::ptrdiff_t>(slices.size())) {
    notes.push_back(
        fmt::format("{} of {} slices have an epicardium: elsewhere it is that of the long-axis "
                    "contours, and interpolated between them",
                    slices.size() - static_cast<std::size_t>(open), slices.size()));
    return;
  }
  for (const int slice : slices)
    if (is_open(slice))
      notes.push_back(
          fmt::format("slice {} has no epicardium: interpolated from its neighbours", slice));
}

/// Where the most basal loop of a side leaves a gap below the base plane.
void note_extrapolated_base(const Contours& contours, const Frame& frame, FitReport& notes) {
  constexpr double tolerance = 1.0;  // [mm]
  for (const Side side : {Side::endo, Side::epi})
    for (const int slice : slices_from_base(contours)) {
      const Contour* loop = find(contours.short_axis, slice, side);
      if (loop == nullptr)
        continue;
      double lowest = 0.0;
      for (const Vec3& x : loop->points)
        lowest = std::min(lowest, frame.to_model(x).z());
      if (lowest < -tolerance)
        assume(
            "base",
            fmt::format("{} is extrapolated by up to {:.1f} mm from slice {} to the base plane{}",
                        name(side), -lowest, slice,
                        contours.long_axis.empty() ? "" : ", led by long-axis contours"),
            notes);
      break;
    }
}

}  // namespace

SplineWall::SplineWall(const Frame& frame, MeridianMaps maps, FitReport report)
    : frame_(frame), maps_(std::move(maps)), report_(std::move(report)) {}

Vec3 SplineWall::point(double u, double theta, double t) const {
  Vec3 x = (1.0 - t) * maps_.endo.point(u, theta) + t * maps_.epi.point(u, theta);
  if (u == 1.0)
    x.z() = 0.0;  // rounding off
  return x;
}

bool moves_slices(const Contours& contours, const SplineFitParameters& parameters) {
  return shown_by_long_axes(contours) ? parameters.correct_shifts : parameters.align_slices;
}

std::vector<Vec3> slice_shifts(const Contours& contours, const SplineFitParameters& parameters) {
  const std::vector<int> slices = slices_from_base(contours);
  if (!moves_slices(contours, parameters))
    return std::vector<Vec3>(slices.size(), Vec3::Zero());
  const Frame frame = model_frame(contours, parameters.frame);
  const Sampler sampler(contours, frame, parameters);
  std::vector<Vec3> shifts = fit_surfaces(sampler.movable_data(), parameters).shifts;
  for (std::size_t k = 0; k < slices.size(); ++k) {
    shifts[k] = frame.axes * shifts[k];
    if (shifts[k].norm() > parameters.largest_shift)
      throw InputError(
          find(contours.short_axis, slices[k], Side::endo)->where(),
          fmt::format("slice {} lies {:.1f} mm from where {} put it; at most {:g} mm are accepted",
                      slices[k], shifts[k].norm(),
                      shown_by_long_axes(contours) ? "the long-axis contours" : "its neighbours",
                      parameters.largest_shift),
          "Check that all contours show the same time of the heartbeat, or redraw the slice");
  }
  return shifts;
}

SplineWall fit_spline_wall(const Contours& contours, const SplineFitParameters& parameters) {
  const std::vector<Vec3> shifts = slice_shifts(contours, parameters);
  FitReport said;
  Contours placed = moved(contours, shifts);
  if (moves_slices(contours, parameters))
    placed = without_stray_tips(std::move(placed), parameters.frame, said.notes);
  const Frame frame = model_frame(placed, parameters.frame);
  for (const Contour& loop : placed.short_axis)
    check_star_shaped(loop, frame);

  Sampler sampler(placed, frame, parameters);
  sampler.add_assumed_apexes(said);
  note_missing_epicardium(placed, said.notes);
  note_extrapolated_base(placed, frame, said);

  const FittedSurfaces fit = fit_surfaces(sampler.data(), parameters);
  check_surfaces(placed, fit);
  FitReport report = measure_fit(placed, frame, fit.endo, fit.epi, parameters.margin);
  for (std::size_t k = 0; k < shifts.size(); ++k)
    report.short_axis[k].shift = shifts[k];
  report.notes = std::move(said.notes);
  report.assumed = std::move(said.assumed);
  check_wall(placed, frame, report.thinnest, parameters.thinnest_wall);
  SplineWall wall(frame, matched_meridians(fit.endo, fit.epi), std::move(report));
  check_inside_out(placed, wall);
  return wall;
}

}  // namespace lv::geometry
