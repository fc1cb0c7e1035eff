#include "lv/circulation/leap.hpp"

#include "lv/base/check.hpp"
#include "lv/circulation/circuit.hpp"

#include <cmath>

namespace lv::circulation {
namespace {

constexpr double rounding = 1e-6;  // of a state: what is left between two rows of beats
constexpr int most_beats = 200;

/// The measures of a ventricle that was filled and has ejected.
bool has_beaten(const BeatMeasures& m) {
  return std::isfinite(m.end_diastolic_volume) && std::isfinite(m.end_systolic_volume) &&
         std::isfinite(m.end_diastolic_pressure) && m.end_diastolic_pressure > 0.0;
}

/// The states after a beat of the stand-in.
std::vector<double> after_beat(CircuitParameters p, const StandIn& ventricle,
                               const std::vector<double>& states) {
  p.start = start_of(states);
  return run_alone(p, ventricle).states;
}

/// That beats as the ventricle did.
StandIn stand_in_of(const BeatenStates& beaten) {
  return {
      beaten.beat, beaten.measures.end_diastolic_volume, {beaten.measures.end_diastolic_pressure}};
}

/// Nothing where the two rows do not come together.
std::optional<std::vector<double>> newton_step(const CircuitParameters& p, const StandIn& ventricle,
                                               std::vector<double> behind,
                                               std::vector<double> ahead) {
  std::vector<double> limit = behind;
  for (int n = 0; n < most_beats; ++n) {
    for (std::size_t i = 0; i < limit.size(); ++i)
      limit[i] += ahead[i] - behind[i];
    if (largest_change(behind, ahead) < rounding)
      return limit;
    behind = after_beat(p, ventricle, behind);
    ahead = after_beat(p, ventricle, ahead);
  }
  return {};
}

}  // namespace

std::optional<std::vector<double>> foretold_limit(const CircuitParameters& p, double step,
                                                  const BeatenStates& beaten) {
  if (!has_beaten(beaten.measures))
    return {};
  CircuitParameters alone = p;
  alone.closed_loop.blood = 0.0;  // the states have it
  alone.step = step;
  alone.beats = 1;
  alone.tolerance = 0.0;
  try {
    return newton_step(alone, stand_in_of(beaten), {beaten.before.begin(), beaten.before.end()},
                       {beaten.after.begin(), beaten.after.end()});
  } catch (const NoSolution&) {
    return {};  // a step of it has no solution: beats go on as they are
  }
}

double change_to_come(const CircuitParameters& p, double step, const BeatenStates& beaten) {
  if (!has_beaten(beaten.measures))
    return 1.0;
  CircuitParameters alone = p;
  alone.step = step;
  return change_to_come(alone, stand_in_of(beaten), beaten.before, beaten.after);
}

}  // namespace lv::circulation
