#include "lv/heartbeat/immersed_cycle.hpp"

#include "lv/base/check.hpp"
#include "lv/base/interrupt.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/heartbeat/checkpoint.hpp"
#include "lv/heartbeat/immersed_steps.hpp"
#include "lv/heartbeat/settling.hpp"
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

constexpr const char* filling_name = "filling";  ///< of a checkpoint: of a wall that is filled

/// Filling as the protocol does it, to another pressure.
Phase filling_to(double pressure, Protocol protocol) {
  protocol.ed_pressure = pressure;
  return phases(protocol).front();
}

/// The places of a base one step before the present one, at its start and at its end.
struct BaseCourse {
  solid::AffineField before, start, end;
};

immersed::HeldBase held_base(const BaseCourse& base, double dt) {
  return {{base.start, solid::BaseStep{base.before, base.start}.at(1.0, dt).velocity},
          solid::BaseStep{base.start, base.end}.at(1.0, dt).velocity};
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
        filling_(filling_to(record_.filling_pressure(), setup.protocol)),
        checkpoint_timer_(setup.output.checkpoint_interval) {}

  Beat run();

 private:
  void begin_filling();
  void fill();
  void fill_step();
  [[nodiscard]] bool is_filled() const;
  void hold_filling_base(double dt);
  void begin_beat();
  void step();
  void end_beat();
  [[nodiscard]] bool has_failed();
  void take_back(const std::string& why);
  [[nodiscard]] solid::Loads loads() const;
  void observe();
  void record_curve();
  void write_frame();
  [[nodiscard]] Snapshot snapshot() const;
  void housekeeping();
  [[nodiscard]] std::string place() const;
  void report_progress();
  void report_filling();
  void count_time();
  void begin_counting();
  void keep() { kept_ = {model_.state(), record_}; }
  void keep_sometimes();
  void save();
  [[nodiscard]] bool resume();

  /// The beats have not begun.
  [[nodiscard]] bool is_filling() const { return record_.cycle().samples.empty(); }
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
  [[nodiscard]] Place load_place(Archive archive, bool of_filling);

  static constexpr int steps_of_response = 10;  ///< that see the same response to the pressure
  static constexpr int steps_kept = 200;        ///< between places to go back to

  const BeatSetup& setup_;
  std::filesystem::path folder_;
  const Observers& observers_;
  immersed::Model model_;
  ImmersedSteps steps_;
  CycleRecord record_;  ///< while the wall is filled, its run alone
  Phase filling_;
  immersed::StepReport last_;
  std::optional<Place> kept_;  ///< to go back to when a step fails

  Timer checkpoint_timer_;
  static constexpr double report_interval = 5.0;  // [s]
  Timer progress_timer_{report_interval};
  TimeLeft left_;
  double counted_until_ = wall_clock();
  double begun_time_ = 0.0;  ///< simulated time from which the time left is counted [s]
};

Beat ImmersedCycleRun::run() {
  if (!resume())
    begin_filling();
  begin_counting();
  if (is_filling()) {
    fill();
    begin_beat();
    begin_counting();
  }
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

/// Of the filling, or of the beats: what came before says nothing of the time left.
void ImmersedCycleRun::begin_counting() {
  begun_time_ = state().time;
  left_ = TimeLeft();
  progress_timer_ = Timer(report_interval);
}

void ImmersedCycleRun::begin_filling() {
  model_.slacken();
  state().steady = criterion(filling_);
  keep();
}

/// From the undeformed wall to one at rest under the pressure before the mitral valve.
void ImmersedCycleRun::fill() {
  while (!is_filled()) {
    fill_step();
    housekeeping();
  }
  model_.balance(setup_.protocol.calcium.Ca_0);
  record_.start(model_.cavity_volume(), record_.filling_pressure());
}

void ImmersedCycleRun::fill_step() {
  const double time = state().time;
  const double dt = steps_.size(state());
  hold_filling_base(dt);
  last_ = model_.step(filling_.loads(time), dt, time >= filling_.settled ? filling_.drag : 0.0);
  state().time += dt;
  if (has_failed())
    return;
  state().steady.record(state().time, model_.cavity_volume());
  keep_sometimes();
}

/// A base that moves is taken to where a beat begins as the pressure rises.
void ImmersedCycleRun::hold_filling_base(double dt) {
  const solid::AffineField there = setup_.base_motion.at(0.0);
  const auto at = [&](double time) {
    return solid::between({}, there, smooth_step(time / filling_.ramp));
  };
  const double time = state().time;
  model_.hold_base(held_base({at(time - dt), at(time), at(time + dt)}, dt));
}

bool ImmersedCycleRun::is_filled() const {
  if (state().time >= filling_.settled && state().steady.reached())
    return true;
  if (state().time < filling_.longest)
    return false;
  log::warn(
      "filling did not meet its end criterion within {} s: the volume still varies by {:.2g}% "
      "per {} s",
      filling_.longest, 100.0 * state().steady.variation(), filling_.window);
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
  // the circuit goes by what the endocardium sweeps against the lid, not by the fan at its edge
  const double share_of_base = model_.cavity_volume() - record_.now().signals.volume;
  const auto pressure = [&](immersed::StepVolume wall) {
    wall.volume -= share_of_base;
    return matching_pressure(wall, circuit);
  };
  const auto base_at = [&](double since) { return setup_.base_motion.at(since); };
  const double since = record_.since();
  model_.hold_base(held_base({base_at(since - dt), base_at(since), base_at(since + dt)}, dt));
  last_ = model_.step(loads(), dt, pressure, is_at_stop());
  if (has_failed())
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

bool ImmersedCycleRun::has_failed() {
  const std::string why = steps_.failure(last_, state());
  if (why.empty())
    return false;
  take_back(why);
  return true;
}

void ImmersedCycleRun::take_back(const std::string& why) {
  count_time();
  const std::string where = place();
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
    throw Interrupted(fmt::format("stopped at {}; run the same command again to go on", place()));
  }
  const double now = wall_clock();
  if (checkpoint_timer_.due(now))
    save();
  if (progress_timer_.due(now))
    is_filling() ? report_filling() : report_progress();
}

std::string ImmersedCycleRun::place() const {
  return is_filling() ? fmt::format("{:.4f} s of filling", state().time)
                      : fmt::format("{:.4f} s of beat {}", record_.since(), record_.beat() + 1);
}

void ImmersedCycleRun::report_filling() {
  left_.record(state().time - begun_time_);
  const double left = settling_time_left(filling_, state().time, state().steady) +
                      setup_.protocol.cycle.beats * record_.period();
  log::info("filling {:.3f} s  {:.1f} mmHg  {:.1f} ml{}", state().time,
            filling_.loads(state().time).pressure / mmHg, 1e-3 * model_.cavity_volume(),
            left_.words(left));
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
  if (is_filling())
    heartbeat::store(record.run(), archive);
  else
    record.store(archive);
  archive.add("model", heartbeat::archived(model, model_.transform()));
  return archive;
}

void ImmersedCycleRun::save() {
  count_time();
  Archive archive;
  archive.set(filling_name, {is_filling() ? 1.0 : 0.0});
  archive.add("now", archived_place(model_.state(), record_));
  archive.add("kept", archived_place(kept_->model, kept_->record));
  parallel::on_root([&] { archive.write(folder_ / checkpoint_name); });
}

ImmersedCycleRun::Place ImmersedCycleRun::load_place(Archive archive, bool of_filling) {
  CycleRecord record = record_;
  const std::size_t nodes = setup_.mesh.nodes.size();
  if (of_filling)
    record.run() = load_run_state(archive, {filling_}, nodes);
  else
    record.load(archive, nodes);
  return {load_model_state(archive.take("model"), model_), std::move(record)};
}

bool ImmersedCycleRun::resume() {
  const std::filesystem::path file = folder_ / checkpoint_name;
  if (!parallel::root_says(std::filesystem::exists(file)))
    return false;
  Archive archive = Archive::read(file);
  const bool of_filling = archive.whole_number(archive.number(filling_name), {0.0, 1.0}) == 1;
  Place now = load_place(archive.take("now"), of_filling);
  kept_ = load_place(archive.take("kept"), of_filling);
  model_.restore(now.model);
  record_ = std::move(now.record);
  log::info("going on from {}", place());
  return true;
}

}  // namespace

Beat run_immersed_cycle(const BeatSetup& setup, const circulation::CircuitParameters& circuit,
                        const std::filesystem::path& folder, const Observers& observers) {
  return ImmersedCycleRun(setup, circuit, folder, observers).run();
}

}  // namespace lv::heartbeat
