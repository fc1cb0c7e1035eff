#pragma once

#include "lv/circulation/cycle.hpp"

#include <optional>
#include <span>
#include <vector>

namespace lv::circulation {

/// A circuit's states where a ventricle's beat began and where it ended, and what it showed
/// between.
struct BeatenStates {
  std::span<const double> before, after;
  std::span<const Sample> beat;
  const BeatMeasures& measures;
};

/// The states where a beat of the limit cycle begins to which the ventricle would come: Newton's
/// method for y = W(y) of its beats W, with the slopes of a StandIn's beats S,
///
///   y + (I - S')^-1 (W(y) - y) = y + sum_n [S^n(W(y)) - S^n(y)],
///
/// the whole way where the stand-in beats as the ventricle does, and nothing where W(y) = y,
/// whatever the stand-in does. A closed loop's vessels take tens of beats there. Nothing where the
/// ventricle did not beat or no such cycle is found. p.step, p.start, p.beats and p.tolerance do
/// not count.
[[nodiscard]] std::optional<std::vector<double>> foretold_limit(const CircuitParameters& p,
                                                                double step,
                                                                const BeatenStates& beaten);

/// What beats to come would add to the change that the ventricle's beat made, with the slopes of a
/// stand-in that beats as it did: see change_to_come. 1 where the ventricle did not beat.
[[nodiscard]] double change_to_come(const CircuitParameters& p, double step,
                                    const BeatenStates& beaten);

}  // namespace lv::circulation
