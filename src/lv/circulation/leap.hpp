#pragma once

#include "lv/circulation/cycle.hpp"

#include <optional>
#include <span>
#include <vector>

namespace lv::circulation {

/// The states of a circuit where a beat of the limit cycle begins, if its ventricle goes on beating
/// as it did in the beat that has led to `states`: a circulation with a StandIn in its place comes
/// there at once, where a closed loop's vessels take tens of beats. Nothing where the ventricle did
/// not beat or no such cycle is found. p.step, p.start, p.beats and p.tolerance do not count.
[[nodiscard]] std::optional<std::vector<double>> foretold_limit(const CircuitParameters& p,
                                                                double step,
                                                                std::span<const double> states,
                                                                std::span<const Sample> beat,
                                                                const BeatMeasures& measures);

}  // namespace lv::circulation
