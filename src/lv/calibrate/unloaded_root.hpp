#pragma once

#include "lv/calibrate/bracket.hpp"

namespace lv::calibrate {

/// The stiffness with which a wall that was seen under pressure holds the target's volume without
/// load, within `accuracy` as a fraction. That volume rises with the stiffness, towards `seen`; the
/// search is a secant's in the logarithms of the stiffness and of the volume that the cavity takes
/// up under the pressure, seen - V, which are nearly proportional, kept within the bracket.
///
/// Stiff walls have a shape without load, soft ones need not: from where there is none the search
/// goes to stiffer ones, and to softer ones again in steps that it shortens. Throws OutOfReach with
/// the volumes at the end of what can be reached when the target is beyond; its `missing` is zero
/// where walls without load, not the range, end there, since another mesh may have them. That is
/// so too before any was found where a folded one holds more than the target
/// (Model::folded_volume): softer muscle, which would hold less, folds more.
[[nodiscard]] double find_unloaded_root(const std::function<Outcome<double>(double)>& volume,
                                        const Unknown& stiffness, const Target& target, double seen,
                                        double accuracy,
                                        const std::function<double()>& folded_volume = {});

}  // namespace lv::calibrate
