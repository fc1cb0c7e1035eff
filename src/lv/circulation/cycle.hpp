#pragma once

#include "lv/circulation/beat_measures.hpp"
#include "lv/circulation/parameters.hpp"
#include "lv/circulation/stand_in.hpp"

#include <limits>
#include <span>
#include <vector>

namespace lv::circulation {

/// Beats of a circulation, up to its limit cycle or their largest number.
struct Cycle {
  std::vector<Sample> samples;  ///< of every step, the start included
  std::vector<BeatMeasures> beats;
  std::vector<Column> columns;                               ///< of Signals::others
  double period = 0.0;                                       ///< of a beat [s]
  double atrium = std::numeric_limits<double>::quiet_NaN();  ///< of measure_beat [s]
  bool is_limit = false;    ///< the last beat is that of a limit cycle: is_limit_cycle
  double change = 0.0;      ///< largest relative change of a state over the last beat
  double to_come = 0.0;     ///< change_to_come; 0 where the last beat's own change says enough
  bool cut_short = false;   ///< the beat after the last found no solution
  int gave_way = 0;         ///< times that a wall joined to it snapped to an equilibrium far off
  double volume_gap = 0.0;  ///< largest |V/V_lv - 1| of a wall's cavity V that is joined to it
  double blood_lost = 0.0;  ///< |blood at the end/blood at the start - 1| of a closed loop
  int leaps = 0;            ///< beats that begin where a stand-in had foretold the limit cycle
};

/// The samples of a whole beat, counted from 0, those that begin and end it included.
[[nodiscard]] std::span<const Sample> samples_of(const Cycle& cycle, int beat);

/// When the left atrium begins to contract in a beat [s]; not a number: a windkessel has none.
[[nodiscard]] double atrial_contraction(const CircuitParameters& parameters);

/// Runs a circulation whose left ventricle is an elastance, by implicit steps of second order, and
/// logs how far it is every few seconds. Throws NoSolution as implicit_step does, and Interrupted.
[[nodiscard]] Cycle run_alone(const CircuitParameters& parameters);

/// The same with another ventricle, and what the circuit has come to.
struct CycleAlone {
  Cycle cycle;
  std::vector<double> states;  ///< as Circuit::states()
};
[[nodiscard]] CycleAlone run_alone(const CircuitParameters& parameters, const StandIn& ventricle);

/// The largest relative change of a state.
[[nodiscard]] double largest_change(std::span<const double> before, std::span<const double> after);

/// What the beats to come would add to the change d that the last one made, r of
///
///   (I - W') r = W' d,
///
/// with the slopes W' of a beat's map of states, by differences; blood that cannot change does not.
/// For one state it is d q/(1 - q), where q is the ratio of successive changes. The largest part of
/// a state; 1: as much as a state or more, or not known because a beat found no solution.
[[nodiscard]] double change_to_come(const CircuitParameters& parameters, const StandIn& ventricle,
                                    std::span<const double> before, std::span<const double> after);

/// A circuit that fills or empties slowly changes little in a beat wherever it is, so the last
/// beat's change alone would call it a limit cycle at its start. What is to come may be this many
/// tolerances, so that changes which fall by a tenth or more from beat to beat, as those of a
/// body's arteries do, are judged by the tolerance alone.
inline constexpr double most_to_come = 10.0;

/// Whether a beat is that of a limit cycle to a tolerance; of 0 none is.
[[nodiscard]] inline bool is_limit_cycle(double change, double to_come, double tolerance) {
  return tolerance > 0.0 && change <= tolerance && to_come <= most_to_come * tolerance;
}

}  // namespace lv::circulation
