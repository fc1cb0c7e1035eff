#pragma once

#include "lv/analysis/results.hpp"
#include "lv/circulation/beat_measures.hpp"
#include "lv/circulation/parameters.hpp"

#include <string>
#include <vector>

namespace lv::report {

/// Of whom a range speaks: of every computed wall, and so of the computation, of the ventricles of
/// healthy adults, or of their muscle, with which a wall that has an infarct is not compared.
enum class Population { any_wall, healthy_ventricle, healthy_muscle };

/// What a beat is judged by.
struct JudgedBeat {
  const analysis::Results& results;
  double muscle_density;  ///< [kg/mm^3]
  bool is_infarcted;
  bool contraction_was_steady;
  bool base_is_held = true;                                 ///< in its plane and from turning
  const circulation::BeatMeasures* heartbeat = nullptr;     ///< the last one, of a circulation
  double period = circulation::CircuitParameters{}.period;  ///< of it [s]
};

/// Where a quantity of a beat is expected, and where no beating heart can be. An end that is not
/// bounded is infinite.
struct PlausibleRange {
  std::string quantity;  ///< its key in summary.json
  std::string label, unit;
  double (*value)(const JudgedBeat& beat);  ///< in that unit; nullptr: that of `measure`
  double low, high;                         ///< of an ejection time: at the usual heart rate
  double possible_low, possible_high;
  Population population;
  bool needs_end_systole;  ///< means nothing where contraction was not steady
  std::string source;
  double circulation::BeatMeasures::*measure = nullptr;  ///< of a heartbeat
};

/// The one list of ranges.
[[nodiscard]] const std::vector<PlausibleRange>& plausible_ranges();

enum class Answer { within, outside, not_applicable };

[[nodiscard]] std::string name(Answer answer);

/// A number beside its range, whose ends an ejection time's heart rate moves as it does systole's.
struct Judgement {
  const PlausibleRange* range;
  double low, high;
  double value;
  Answer answer;
  std::string reason;  ///< why the range does not apply, or why the value cannot be
  bool is_impossible;
};

/// All quantities of plausible_ranges that the beat has, in its order.
[[nodiscard]] std::vector<Judgement> judge(const JudgedBeat& beat);

/// A sentence for each value that cannot be.
[[nodiscard]] std::vector<std::string> impossible_values(const std::vector<Judgement>& judgements);

/// Whether the aortic valve is open as the mitral valve closes: the pressure of the arteries has
/// fallen below that which fills the ventricle.
[[nodiscard]] bool is_open_in_diastole(const circulation::BeatMeasures& beat);

/// A sentence of such an aortic valve; empty else.
[[nodiscard]] std::string open_aortic_valve(const circulation::BeatMeasures& beat);

/// That sentence, and one for each measure of a heartbeat that lies where no patient's is: beyond
/// what is possible of those of plausible_ranges and of the ejection fraction, a volume beyond half
/// the least and twice the largest there, a stroke volume beyond those times the fractions there.
/// What did not happen is not judged.
[[nodiscard]] std::vector<std::string> unlike_any_patient(const circulation::BeatMeasures& beat);

}  // namespace lv::report
