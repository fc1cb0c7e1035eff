#include "lv/geometry/drawn_wall.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
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
      "the slices seem shifted against each other (breath-holds): their contours lie "
      "up to {:.1f} mm (rms {:.1f} mm) from the wall; {} {}",
      as_drawn.most, as_drawn.rms, align, says(after));
}

/// Refuses contours, with what would make a wall of them.
[[noreturn]] void refuse(const Contours& contours, SplineFitParameters parameters,
                         const Attempt& failed) {
  if (const Attempt moved = aligned(contours, parameters); moved.wall)
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
                         bool base_may_move) {
  SplineFitParameters used = parameters;
  std::vector<std::string> notes;
  Attempt found = attempt(contours, used);
  if (!found.wall && base_may_move && used.frame.base_at == BaseAt::annulus) {
    notes.push_back(fmt::format(
        "the base plane is laid where the slab of the most basal slice ends: through the mitral "
        "annulus there is no wall ({})",
        found.why.substr(0, found.why.find(". "))));
    used.frame.base_at = BaseAt::slab;
    found = attempt(contours, used);
  }
  if (!found.wall)
    refuse(contours, used, found);
  if (const std::string note = alignment_note(contours, used, found.wall->report()); !note.empty())
    notes.push_back(note);
  return {std::move(*found.wall), used.frame.base_at, std::move(notes)};
}

}  // namespace lv::geometry
