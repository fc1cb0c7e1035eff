#include "lv/heartbeat/immersed_cycle.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/heartbeat/checkpoint.hpp"
#include "lv/heartbeat/immersed_steps.hpp"
#include "lv/heartbeat/timer.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace lv::heartbeat {

double matching_pressure(const immersed::StepVolume& wall,
                         const std::function<circulation::VolumeAfter(double)>& circuit) {
  constexpr int most = 50;           // corrections; valves need some five
  constexpr double rounding = 1e-8;  // [kPa]
  double p = wall.guess;
  for (int i = 0; i < most && std::isfinite(p); ++i) {
    const auto [volume, per_pressure] = circuit(p);
    const double gap = wall.volume + wall.per_pressure * (p - wall.guess) - volume;
    const double correction = -gap / (wall.per_pressure - per_pressure);
    p += correction;
    if (std::abs(correction) <= rounding * (1.0 + std::abs(p)))
      return p;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

namespace {

using units::mmHg;

/// Filling as the protocol does it, to another pressure.
Phase filling_to(double pressure, Protocol protocol) {
  protocol.ed_pressure = pressure;
  return phases(protocol).front();
}

/// The steps of a wall in blood are its own; those of a stand-in for it are the other engine's.
CycleCourse course_of(const BeatSetup& setup, const circulation::CircuitParameters& circuit) {
  CycleCourse course{setup.protocol.calcium, circuit, setup.protocol.cycle,
                     setup.output.frame_interval};
  course.cycle.step = CycleParameters{}.step;
  return course;
}

class ImmersedCycleRun {
 public:
  ImmersedCycleRun(const BeatSetup& setup, const circulation::CircuitParameters& circuit,
                   std::filesystem::path folder, const Observers& observers)
      : setup_(setup),
        folder_(std::move(folder)),
        observers_(observers),
        model_(setup.mesh, setup.heart, setup.model),
        steps_(setup.control, model_, setup.model.blood.density),
        record_(course_of(setup, circuit)),
        checkpoint_timer_(setup.output.checkpoint_interval) {}

  Beat run();

 private:
  void fill();
  [[nodiscard]] bool is_filled(const Phase& phase) const;
  void begin_beat();
  void step();
  void end_beat();
  [[nodiscard]] bool has_failed(const std::string& where);
  void take_back(const std::string& where, const std::string& why);
  [[nodiscard]] solid::Loads loads() const;
  void observe();
  void record_curve();
  void write_frame();
  [[nodiscard]] Snapshot snapshot() const;
  void housekeeping();
  void report_progress();
  void count_time();
  void keep() { kept_ = {model_.state(), record_}; }
  void keep_sometimes();
  void save();
  [[nodiscard]] bool resume();

  [[nodiscard]] RunState& state() { return record_.run(); }
  [[nodiscard]] const RunState& state() const { return record_.run(); }
  /// Whether the run may be stored now: the response to the pressure is found anew in the next
  /// step.
  [[nodiscard]] bool is_at_stop() const { return state().beat.steps % steps_of_response == 0; }

  /// What a run goes on from, or back to.
  struct Place {
    immersed::ModelState model;
    CycleRecord record;
  };
  [[nodiscard]] Archive archived_place(const immersed::ModelState& model,
                                       const CycleRecord& record) const;
  [[nodiscard]] Place load_place(Archive archive);

  static constexpr int steps_of_response = 10;  ///< that see the same response to the pressure
  static constexpr int steps_kept = 200;        ///< between places to go back to

  const BeatSetup& setup_;
  std::filesystem::path folder_;
  const Observers& observers_;
  immersed::Model model_;
  ImmersedSteps steps_;
  CycleRecord record_;
  immersed::StepReport last_;
  std::optional<Place> kept_;  ///< to go back to when a step fails

  Timer checkpoint_timer_;
  Timer progress_timer_{5.0};
  TimeLeft left_;
  double counted_until_ = wall_clock();
  double begun_time_ = 0.0;  ///< simulated time at which this process took over [s]
};

Beat ImmersedCycleRun::run() {
  if (!resume()) {
    fill();
    begin_beat();
  }
  begun_time_ = state().time;
  while (!record_.done()) {
    step();
    if (!record_.done())
      housekeeping();
  }
  count_time();
  Beat beat = record_.result(observers_);
  beat.activation_times = setup_.activation_times;
  return beat;
}

/// From the undeformed wall to one at rest under the pressure before the mitral valve.
void ImmersedCycleRun::fill() {
  const double pressure = record_.filling_pressure();
  const Phase phase = filling_to(pressure, setup_.protocol);
  model_.slacken();
  state().steady = criterion(phase);
  keep();
  while (!is_filled(phase)) {
    if (is_at_stop())
      interrupt::check_together();
    const double time = state().time;
    const double dt = steps_.size(state());
    last_ = model_.step(phase.loads(time), dt, time >= phase.settled ? phase.drag : 0.0);
    state().time += dt;
    if (has_failed(fmt::format("{:.4f} s of filling", time)))
      continue;
    state().steady.record(state().time, model_.cavity_volume());
    keep_sometimes();
    if (is_at_stop() && progress_timer_.due(wall_clock()))
      log::info("filling {:.3f} s  {:.1f} mmHg  {:.1f} ml", state().time,
                phase.loads(state().time).pressure / mmHg, 1e-3 * model_.cavity_volume());
  }
  model_.balance(setup_.protocol.calcium.Ca_0);
  record_.start(model_.cavity_volume(), pressure);
}

bool ImmersedCycleRun::is_filled(const Phase& phase) const {
  if (state().time >= phase.settled && state().steady.reached())
    return true;
  if (state().time < phase.longest)
    return false;
  log::warn(
      "filling did not meet its end criterion within {} s: the volume still varies by {:.2g}% "
      "per {} s",
      phase.longest, 100.0 * state().steady.variation(), phase.window);
  return true;
}

void ImmersedCycleRun::begin_beat() {
  record_.begin_beat();
  if (record_.mitral_valve_is_closed())
    record_.mark(valve_events[0], false, snapshot());
  write_frame();
  record_curve();
  keep();
}

/// One step, from which the run goes back when it fails.
void ImmersedCycleRun::step() {
  const double dt = record_.step_size(steps_.size(state()));
  const auto circuit = [&](double p) { return record_.volume_after(dt, p); };
  // the circuit goes by what the endocardium sweeps; the fan at the base is no part of it
  const double share_of_base = model_.cavity_volume() - record_.now().signals.volume;
  const auto pressure = [&](immersed::StepVolume wall) {
    wall.volume -= share_of_base;
    return matching_pressure(wall, circuit);
  };
  last_ = model_.step(loads(), dt, pressure, is_at_stop());
  if (has_failed(fmt::format("{:.4f} s of beat {}", record_.since(), record_.beat() + 1)))
    return;
  const bool is_sample = record_.begin() + record_.after(dt) >= state().next_curve;
  record_.step(dt, last_.pressure, model_.cavity_volume(), is_sample);
  observe();
  if (record_.beat_is_over())
    end_beat();
  keep_sometimes();
}

/// Calcium of each node where muscle is activated at different times.
solid::Loads ImmersedCycleRun::loads() const {
  solid::Loads loads{.pressure = record_.pressure(), .calcium = record_.calcium(record_.since())};
  for (const double delay : setup_.activation_times)
    loads.calcium_at_nodes.push_back(record_.calcium(record_.since(), delay));
  return loads;
}

void ImmersedCycleRun::end_beat() {
  count_time();
  record_.end_beat();
  if (!record_.done())
    begin_beat();
}

bool ImmersedCycleRun::has_failed(const std::string& where) {
  const std::string why = steps_.failure(last_, state());
  if (why.empty())
    return false;
  take_back(where, why);
  return true;
}

void ImmersedCycleRun::take_back(const std::string& where, const std::string& why) {
  count_time();
  const RunState failed = state();
  model_.restore(kept_->model);
  record_ = kept_->record;
  ImmersedSteps::go_back(failed, state());
  if (!steps_.gives_up(state())) {
    log::warn("at {} {}; back by {:.4f} s with steps of {:.3g} s", where, why,
              failed.time - state().time, steps_.size(state()));
    return;
  }
  const NoSolution unstable = steps_.unstable(where, why);
  record_.stop_early(unstable, unstable.what(), observers_);
}

void ImmersedCycleRun::observe() {
  if (const ValveEvent* event = record_.event()) {
    record_.mark(*event, true, snapshot());
    write_frame();
  }
  if (state().time >= state().next_curve || record_.beat_is_over())
    record_curve();
  if (record_.frame_is_due())
    write_frame();
}

void ImmersedCycleRun::record_curve() {
  const auto motion =
      fluid::motion(model_.velocity(), setup_.model.grid, setup_.model.blood.density);
  CurveRow row = record_.row();
  const solid::Loads now = loads();
  row.calcium = now.calcium_at_nodes.empty() ? now.calcium : model_.mean(now.calcium_at_nodes);
  row.mean_tension = model_.mean_tension();
  row.kinetic_energy = motion.kinetic_energy;
  row.largest_velocity = motion.largest_velocity;
  row.min_J = last_.J.min_J;
  row.max_J = last_.J.max_J;
  row.step = steps_.size(state());
  state().beat.curves.push_back(row);
  while (state().next_curve <= state().time)
    state().next_curve += setup_.output.curve_interval;
}

void ImmersedCycleRun::write_frame() {
  const std::optional<int> number = record_.frame_number(state().time);
  if (!number || !observers_.frame)
    return;
  const fluid::Component pressure = model_.pressure();
  observers_.frame({*number, snapshot(), state(), Blood{model_, pressure}});
}

Snapshot ImmersedCycleRun::snapshot() const {
  const auto x = model_.positions();
  const auto tension = model_.contraction().tension();
  return {state().time,
          record_.pressure(),
          model_.cavity_volume(),
          {x.begin(), x.end()},
          {tension.begin(), tension.end()},
          {}};
}

void ImmersedCycleRun::keep_sometimes() {
  if (state().beat.steps % steps_kept == 0)
    keep();
}

void ImmersedCycleRun::housekeeping() {
  if (!is_at_stop())
    return;
  if (parallel::any(interrupt::requested())) {
    save();
    record_.show_progress(observers_);
    throw Interrupted(
        fmt::format("stopped at {:.4f} s of beat {}; run the same command again to go on",
                    record_.since(), record_.beat() + 1));
  }
  const double now = wall_clock();
  if (checkpoint_timer_.due(now))
    save();
  if (progress_timer_.due(now))
    report_progress();
}

void ImmersedCycleRun::report_progress() {
  left_.record(state().time - begun_time_);
  const double left = record_.period() - record_.since() + record_.beats_left() * record_.period();
  log::info(
      "beat {} (of {} at most)  {:.3f} of {:.3g} s  {}  {:.1f} mmHg  {:.1f} ml  tension {:.1f} "
      "kPa  local volume {:.2f} to {:.2f}{}",
      record_.beat() + 1, setup_.protocol.cycle.beats, record_.since(), record_.period(),
      record_.phase(), record_.pressure() / mmHg, 1e-3 * model_.cavity_volume(),
      model_.mean_tension(), last_.J.min_J, last_.J.max_J, left_.words(left));
  record_.show_progress(observers_);
}

void ImmersedCycleRun::count_time() {
  const double now = wall_clock();
  state().beat.wall_clock += now - counted_until_;
  counted_until_ = now;
}

Archive ImmersedCycleRun::archived_place(const immersed::ModelState& model,
                                         const CycleRecord& record) const {
  Archive archive;
  record.store(archive);
  archive.add("model", heartbeat::archived(model, model_.transform()));
  return archive;
}

void ImmersedCycleRun::save() {
  count_time();
  Archive archive;
  archive.add("now", archived_place(model_.state(), record_));
  archive.add("kept", archived_place(kept_->model, kept_->record));
  parallel::on_root([&] { archive.write(folder_ / checkpoint_name); });
}

ImmersedCycleRun::Place ImmersedCycleRun::load_place(Archive archive) {
  CycleRecord record = record_;
  record.load(archive, setup_.mesh.nodes.size());
  return {load_model_state(archive.take("model"), model_), std::move(record)};
}

bool ImmersedCycleRun::resume() {
  const std::filesystem::path file = folder_ / checkpoint_name;
  if (!parallel::root_says(std::filesystem::exists(file)))
    return false;
  Archive archive = Archive::read(file);
  Place now = load_place(archive.take("now"));
  kept_ = load_place(archive.take("kept"));
  model_.restore(now.model);
  record_ = std::move(now.record);
  log::info("going on from {:.4f} s of beat {}", record_.since(), record_.beat() + 1);
  return true;
}

}  // namespace

Beat run_immersed_cycle(const BeatSetup& setup, const circulation::CircuitParameters& circuit,
                        const std::filesystem::path& folder, const Observers& observers) {
  return ImmersedCycleRun(setup, circuit, folder, observers).run();
}

}  // namespace lv::heartbeat
