#include "lv/circulation/leap.hpp"

#include "lv/base/check.hpp"
#include "lv/circulation/circuit.hpp"

#include <algorithm>
#include <cmath>

namespace lv::circulation {
namespace {

constexpr double well_below_beats = 1e-5;  // change of the last beat of a stand-in
constexpr int most_beats = 300;

/// The measures of a ventricle that was filled and has ejected.
bool has_beaten(const BeatMeasures& m) {
  return std::isfinite(m.end_diastolic_volume) && std::isfinite(m.end_systolic_volume) &&
         std::isfinite(m.end_diastolic_pressure) && m.end_diastolic_pressure > 0.0;
}

}  // namespace

std::optional<std::vector<double>> foretold_limit(const CircuitParameters& p, double step,
                                                  std::span<const double> states,
                                                  std::span<const Sample> beat,
                                                  const BeatMeasures& measures) {
  if (!has_beaten(measures))
    return {};
  CircuitParameters alone = p;
  alone.start = start_of(states);
  alone.closed_loop.blood = 0.0;  // the states have it
  alone.step = step;
  alone.beats = most_beats;
  alone.tolerance = well_below_beats;
  const StandIn ventricle(beat, measures.end_diastolic_volume, {measures.end_diastolic_pressure});
  try {
    CycleAlone end = run_alone(alone, ventricle);
    const bool is_cycle = end.cycle.is_limit && has_beaten(end.cycle.beats.back());
    return is_cycle ? std::optional(std::move(end.states)) : std::nullopt;
  } catch (const RunError&) {
    return {};  // a step of it has no solution: beats go on as they are
  }
}

}  // namespace lv::circulation
