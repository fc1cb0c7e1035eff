#include "lv/geometry/drawn_wall.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/contour_measures.hpp"
#include "lv/geometry/long_axis.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace lv::geometry {
namespace {

/// A wall, or why there is none.
struct Attempt {
  std::optional<SplineWall> wall;
  std::string where, why;
};

Attempt attempt(const Contours& contours, const SplineFitParameters& parameters) {
  try {
    return {fit_spline_wall(contours, parameters), {}, {}};
  } catch (const InputError& error) {
    const std::string text = error.what();
    return {{}, error.where(), text.substr(std::min(text.size(), error.where().size() + 2))};
  }
}

/// Distances of the short-axis contours from a wall, and how its slices were moved [mm].
struct Misfit {
  double rms = 0.0, most = 0.0, largest_shift = 0.0;
};

Misfit misfit_of(const FitReport& report) {
  Misfit misfit;
  double points = 0.0;
  for (const ImageReport& image : report.short_axis) {
    misfit.largest_shift = std::max(misfit.largest_shift, image.shift.norm());
    for (const auto& side : {image.endo, image.epi})
      if (side) {
        points += side->points;
        misfit.rms += side->points * side->rms * side->rms;
        misfit.most = std::max(misfit.most, side->max);
      }
  }
  misfit.rms = std::sqrt(misfit.rms / std::max(points, 1.0));
  return misfit;
}

std::string says(const Misfit& aligned) {
  return fmt::format(
      "moves them by up to {:.1f} mm in their planes and leaves {:.1f} mm (rms {:.1f} mm)",
      aligned.largest_shift, aligned.most, aligned.rms);
}

/// Where a base plane lies, in words.
const char* words(BaseAt at) {
  return at == BaseAt::slice ? "through the most basal slice"
         : at == BaseAt::slab
             ? "half a slice spacing above the most basal slice, where its slab ends"
             : "through the mitral annulus";
}

constexpr const char* at_end_of_muscle = "as high as the long-axis curves show muscle all round";

/// The highest points of a long-axis curve on both sides of the axis; none where it has no side.
std::vector<Vec3> ends_of(const Contour& curve, const LongAxis& axis) {
  const Vec3 across = plane_of(curve.points).axes.col(2).cross(axis.up);
  std::vector<Vec3> ends;
  for (const double side : {1.0, -1.0}) {
    const Vec3* highest = nullptr;
    for (const Vec3& x : curve.points)
      if (side * (x - axis.point).dot(across) > 0.0 &&
          (highest == nullptr || x.dot(axis.up) > highest->dot(axis.up)))
        highest = &x;
    if (highest != nullptr)
      ends.push_back(*highest);
  }
  return ends;
}

/// The lowest end of the long-axis curves of two or more images; none if they are fewer.
std::optional<Vec3> end_of_muscle(const Contours& contours) {
  if (contours.long_axis.empty())
    return std::nullopt;
  std::set<int> images;
  std::optional<Vec3> lowest;
  const Vec3 basal = mean_of(loops_from_base(contours, Side::endo).front()->points);
  const LongAxis axis = long_axis(contours);
  const double drawn_short = -0.5 * slice_spacing(contours);
  for (const Contour& curve : contours.long_axis)
    for (const Vec3& end : ends_of(curve, axis)) {
      if ((end - basal).dot(axis.up) < drawn_short)
        continue;
      images.insert(curve.slice);
      if (!lowest || end.dot(axis.up) < lowest->dot(axis.up))
        lowest = end;
    }
  return images.size() < 2 ? std::nullopt : lowest;
}

constexpr const char* align = "anatomy.contours.align_slices = true";

/// The wall with the slices moved, if that takes align_slices.
Attempt aligned(const Contours& contours, SplineFitParameters parameters) {
  if (moves_slices(contours, parameters))
    return {};
  parameters.align_slices = true;
  return moves_slices(contours, parameters) ? attempt(contours, parameters) : Attempt{};
}

/// What moving the slices would bring to a wall that there is; empty if nothing.
std::string alignment_note(const Contours& contours, const SplineFitParameters& parameters,
                           const FitReport& report) {
  constexpr double noted = 3.0;  // [mm]
  const Misfit as_drawn = misfit_of(report);
  if (as_drawn.most < noted)
    return {};
  const Attempt moved = aligned(contours, parameters);
  if (!moved.wall)
    return {};
  const Misfit after = misfit_of(moved.wall->report());
  if (after.rms > 0.5 * as_drawn.rms)
    return {};
  return fmt::format(
      "the slices seem shifted against each other (breath-holds): their contours lie up to {:.1f} "
      "mm (rms {:.1f} mm) from the wall; {} {}",
      as_drawn.most, as_drawn.rms, align, says(after));
}

/// The first sentence of why there is no wall.
std::string reason(const Attempt& failed) {
  return failed.why.substr(0, failed.why.find(". "));
}

/// Refuses contours, with what would make a wall of them, if need be of `moved` slices.
[[noreturn]] void refuse(const Contours& contours, SplineFitParameters parameters,
                         const Attempt& failed, const Attempt& moved) {
  if (moved.wall)
    throw InputError(failed.where, failed.why,
                     fmt::format("There is a wall with {}, which {}", align,
                                 says(misfit_of(moved.wall->report()))));
  if (parameters.frame.base_at == BaseAt::annulus) {
    parameters.frame.base_at = BaseAt::slab;
    if (attempt(contours, parameters).wall)
      throw InputError(failed.where, failed.why,
                       "There is a wall with anatomy.contours.base_at = \"slab\"");
  }
  throw InputError(failed.where, failed.why, "");
}

}  // namespace

DrawnWall fit_drawn_wall(const Contours& contours, const SplineFitParameters& parameters,
                         const MayMove& may_move) {
  SplineFitParameters used = parameters;
  Contours drawn = contours;
  std::vector<std::string> notes;
  std::vector<Assumption> warnings;
  std::string base = words(used.frame.base_at);
  const bool base_may_move = may_move.base && used.frame.base_at == BaseAt::annulus;
  if (const auto end = base_may_move ? end_of_muscle(contours) : std::nullopt) {
    drawn.annulus = {*end};
    base = at_end_of_muscle;
  }
  Attempt found = attempt(drawn, used);
  if (!found.wall && base_may_move) {
    used.frame.base_at = BaseAt::slab;
    notes.push_back(
        fmt::format("the base plane is laid where the slab of the most basal slice ends: {} there "
                    "is no wall ({})",
                    base, reason(found)));
    base = words(used.frame.base_at);
    found = attempt(drawn, used);
  }
  if (!found.wall) {
    Attempt moved = aligned(drawn, used);
    if (!moved.wall || !may_move.slices)
      refuse(drawn, used, found, moved);
    warnings.push_back(
        {"moved slices", fmt::format("the slices are moved to each other: as the scanner put them "
                                     "there is no wall ({}); {} {}",
                                     reason(found), align, says(misfit_of(moved.wall->report())))});
    used.align_slices = true;
    found = std::move(moved);
  }
  if (const std::string note = alignment_note(drawn, used, found.wall->report()); !note.empty())
    notes.push_back(note);
  return {std::move(*found.wall), std::move(base), std::move(notes), std::move(warnings)};
}

}  // namespace lv::geometry
