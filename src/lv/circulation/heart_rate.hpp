#pragma once

#include "lv/circulation/parameters.hpp"

namespace lv::circulation {

/// How long systole lasts in beats of a period [s], as a part of what it lasts in those of
/// CircuitParameters:
///
///   QS2 = 546 ms - 2.1 ms HR,   HR = 60 s/period,
///
/// electromechanical systole of healthy men at rest (Weissler et al., Circulation 37:149, 1968). At
/// more than 180 beats a minute, beyond any rest, it keeps its part of the beat.
[[nodiscard]] double relative_systole(double period);

/// The parameters with the times of all chambers in beats of another period: they contract and
/// relax as systole does, and begin before the ventricles by as much less (the right one's t_C for
/// all but the left). The period itself stays.
[[nodiscard]] CircuitParameters with_times_at(double period, CircuitParameters p);

}  // namespace lv::circulation
