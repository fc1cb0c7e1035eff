#pragma once

#include "lv/base/check.hpp"
#include "lv/circulation/circuit.hpp"
#include "lv/circulation/leap.hpp"
#include "lv/heartbeat/observers.hpp"

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lv::heartbeat {

/// An event of a valve: the pressure across it changes its sign.
struct ValveEvent {
  const char* moment;
  const char* ends;  ///< the phase before it
  double circulation::Signals::*gradient;
  bool opens;

  [[nodiscard]] bool between(const circulation::Signals& a, const circulation::Signals& b) const {
    const double x = a.*gradient;
    const double y = b.*gradient;
    return opens ? x <= 0.0 && y > 0.0 : x >= 0.0 && y < 0.0;
  }
  /// Share of the way from one to the other.
  [[nodiscard]] double place(const circulation::Signals& a, const circulation::Signals& b) const {
    return a.*gradient / (a.*gradient - b.*gradient);
  }
};

/// The events of a beat, in their order, and with them its phases: after the last the first comes
/// again.
inline constexpr std::array<ValveEvent, 4> valve_events{
    {{end_diastole, "filling", &circulation::Signals::mitral_gradient, false},
     {aortic_opening, "contraction", &circulation::Signals::aortic_gradient, true},
     {end_systole, "ejection", &circulation::Signals::aortic_gradient, false},
     {mitral_opening, "relaxation", &circulation::Signals::mitral_gradient, true}}};

/// What heartbeats in a circulation go by, whichever engine moves the wall.
struct CycleCourse {
  material::Calcium calcium;  ///< its transient begins anew in every beat, whatever its mode
  circulation::CircuitParameters circuit;
  CycleParameters cycle;
  double frame_interval = 0.1;  ///< between frames of a beat [s]
};

/// Heartbeats underway, whichever engine moves the wall: the circuit beside it, what it showed so
/// far, the beats' moments, and whether they go on. A copy of it is a place to go back to.
///
/// Beats end when the last has changed no state of the circuit, nor end-diastolic or end-systolic
/// volume, by more than the tolerance and beats to come would add little (is_limit_cycle), or with
/// their largest number. Between two beats a closed
/// loop may leap to the limit cycle that is foretold (circulation::foretold_limit); a beat that
/// changes nothing is one of wall and circuit all the same. A leap makes several times of a beat's
/// change, and of what two beats never repeat exactly too: the first beat after one that changes
/// half as much again as the beat before it ends them.
class CycleRecord {
 public:
  /// Throws InputError where there is no circulation.
  explicit CycleRecord(const CycleCourse& course);

  /// The pressure before the mitral valve, at first that of a filled wall [kPa].
  [[nodiscard]] double filling_pressure() const;

  /// Starts around a wall that was filled to a volume [mm^3] by a pressure [kPa].
  void start(double volume, double pressure);

  /// Starts where a beat began with these states of the circuit and this pressure [kPa].
  void start_from(const std::vector<double>& states, double pressure);
  /// Beats before the first were like those that follow; said before the start.
  void goes_on() { beats_before_ = 1; }

  // the beat underway
  void begin_beat();
  [[nodiscard]] int beat() const { return beat_; }                        ///< whole ones so far
  [[nodiscard]] double since() const { return since_; }                   ///< the beat began [s]
  [[nodiscard]] double begin() const { return beat_ * period(); }         ///< of it [s]
  [[nodiscard]] double period() const { return course_.circuit.period; }  ///< [s]
  [[nodiscard]] bool beat_is_over() const { return since_ >= period(); }
  /// The rest of the beat in equal steps of at most `longest` [s].
  [[nodiscard]] double step_size(double longest) const;
  /// What time it is in the beat after a step; its end where only rounding is left [s].
  [[nodiscard]] double after(double dt) const;

  /// Calcium of a point that is activated so long after others [uM]. What began in an earlier beat
  /// goes on until the point is activated again.
  [[nodiscard]] double calcium(double since, double delay = 0.0) const;

  /// The volume that a step leaves, if the pressure at its end is p.
  [[nodiscard]] circulation::VolumeAfter volume_after(double dt, double p) const;
  /// Takes that step beside a wall whose cavity has come to a volume. Its end becomes a sample if
  /// that is wanted, or the beat ends with it.
  void step(double dt, double p, double cavity_volume, bool is_sample = true);

  [[nodiscard]] const circulation::Sample& before() const { return before_; }  ///< the last step
  [[nodiscard]] const circulation::Sample& now() const { return now_; }
  [[nodiscard]] double pressure() const { return now_.signals.pressure; }  ///< [kPa]

  /// What a valve did in the last step; null: nothing. One event may be missed: the mitral valve
  /// was closed all the time, or was not.
  [[nodiscard]] const ValveEvent* event() const;
  /// Whether the beat underway began with a closed mitral valve: then it begins with that event.
  [[nodiscard]] bool mitral_valve_is_closed() const { return now_.signals.mitral_gradient < 0.0; }
  void mark(const ValveEvent& event, bool by_criterion, Snapshot wall);

  /// The number of a frame at this time, unless it has one.
  [[nodiscard]] std::optional<int> frame_number(double time);
  [[nodiscard]] bool frame_is_due() const { return run_.time >= run_.next_frame; }

  /// The curves' row of now, but for what the wall alone knows.
  [[nodiscard]] CurveRow row() const;

  /// The beat is whole: measures it and logs them.
  void end_beat();
  /// The beat underway finds no solution: what whole ones were reached stays, and a warning says
  /// why in `words`. Throws `error` where there is none.
  void stop_early(const NoSolution& error, const std::string& words, const Observers& observers);
  /// Drops the beat underway and ends the beats, without a word.
  void cut_short();
  void gave_way() { ++cycle_.gave_way; }
  [[nodiscard]] bool done() const;
  /// Beats after the one underway, if changes go on falling as they did.
  [[nodiscard]] double beats_left() const;

  /// Of the beat underway; its phase is the number of the next event.
  [[nodiscard]] RunState& run() { return run_; }
  [[nodiscard]] const RunState& run() const { return run_; }
  [[nodiscard]] const char* phase() const;

  /// The samples of the beat underway, its beginning included.
  [[nodiscard]] std::span<const circulation::Sample> samples_of_beat() const {
    return std::span(cycle_.samples).subspan(begins_.back());
  }
  /// All beats so far, and where the circuit is now.
  [[nodiscard]] const circulation::Cycle& cycle() const { return cycle_; }
  [[nodiscard]] std::span<const double> circuit_states() const { return circuit_.states(); }

  /// Tells of all beats so far.
  void show_progress(const Observers& observers);

  /// The last whole beat and all heartbeats. Throws NoSolution when the aortic valve did not open
  /// and close in it.
  [[nodiscard]] Beat result(const Observers& observers);

  void store(Archive& archive) const;
  /// Takes over what an archive holds, of a wall of so many nodes. Throws RunError when the archive
  /// says what no run of this case can come to.
  void load(Archive& archive, std::size_t nodes);

 private:
  /// Whether the beat that has just ended is that of a limit cycle.
  void judge();
  /// It, while the circuit is where it ended.
  [[nodiscard]] circulation::BeatenStates beaten() const;
  void leap();

  CycleCourse course_;
  circulation::Circuit circuit_;
  circulation::Cycle cycle_;
  RunState run_;
  Beat whole_;  ///< the last whole beat: curves, moments and energy
  int beat_ = 0;
  int beats_before_ = 0;  ///< of the same kind, before the first; as many as calcium lasts
  double since_ = 0.0;
  circulation::Sample before_, now_;
  std::vector<std::size_t> begins_;    ///< the samples that beats begin with
  std::vector<double> states_before_;  ///< of the circuit when the beat began
  double change_before_ =
      std::numeric_limits<double>::quiet_NaN();  ///< of the beat before the last
  double blood_at_start_ = 0.0;
  bool leaps_settle_ = true;  ///< no beat has changed much more than the one before it
};

/// Adds what a heartbeat's work was to an archive, and takes it out again.
void store(const EnergyBalance& energy, Archive& archive);
[[nodiscard]] EnergyBalance load_energy(const Archive& archive);

/// Adds heartbeats to an archive, and takes them out again.
void store(const circulation::Cycle& cycle, Archive& archive);
[[nodiscard]] circulation::Cycle load_cycle(const Archive& archive);

}  // namespace lv::heartbeat
