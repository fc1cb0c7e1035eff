#pragma once

#include "lv/circulation/beat_measures.hpp"
#include "lv/circulation/parameters.hpp"
#include "lv/circulation/stand_in.hpp"

#include <functional>
#include <span>
#include <vector>

namespace lv::circulation {

/// Beats of a circulation, up to its limit cycle or their largest number.
struct Cycle {
  std::vector<Sample> samples;  ///< of every step, the start included
  std::vector<BeatMeasures> beats;
  std::vector<Column> columns;  ///< of Signals::others
  double period = 0.0;          ///< of a beat [s]
  bool is_limit = false;        ///< the last beat changed no state by more than the tolerance
  double change = 0.0;          ///< largest relative change of a state over the last beat
  bool cut_short = false;       ///< the beat after the last found no solution
  int gave_way = 0;         ///< times that a wall joined to it snapped to an equilibrium far off
  double volume_gap = 0.0;  ///< largest |V/V_lv - 1| of a wall's cavity V that is joined to it
  double blood_lost = 0.0;  ///< |blood at the end/blood at the start - 1| of a closed loop
  int leaps = 0;            ///< beats that begin where a stand-in had foretold the limit cycle
};

/// The samples of a whole beat, counted from 0, those that begin and end it included.
[[nodiscard]] std::span<const Sample> samples_of(const Cycle& cycle, int beat);

/// Runs a circulation whose left ventricle is an elastance, by implicit steps of second order.
/// Throws NoSolution as implicit_step does, and Interrupted between beats.
[[nodiscard]] Cycle run_alone(const CircuitParameters& parameters);

/// The same with another ventricle, and what the circuit has come to.
struct CycleAlone {
  Cycle cycle;
  std::vector<double> states;  ///< as Circuit::states()
};
[[nodiscard]] CycleAlone run_alone(const CircuitParameters& parameters, const StandIn& ventricle);

/// The largest relative change of a state.
[[nodiscard]] double largest_change(std::span<const double> before, std::span<const double> after);

}  // namespace lv::circulation
