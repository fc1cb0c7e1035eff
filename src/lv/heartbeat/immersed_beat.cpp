#include "lv/heartbeat/immersed_beat.hpp"

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
#include <utility>

namespace lv::heartbeat {
namespace {

using units::mmHg;

class ImmersedRun {
 public:
  ImmersedRun(const BeatSetup& setup, std::filesystem::path folder, const Observers& observers)
      : setup_(setup),
        folder_(std::move(folder)),
        observers_(observers),
        phases_(phases(setup.protocol)),
        model_(setup.mesh, setup.heart, setup.model),
        steps_(setup.control, model_, setup.model.blood.density),
        checkpoint_timer_(setup.output.checkpoint_interval) {}

  Beat run() {
    if (!resume()) {
      start();
      keep();
    }
    begun_time_ = run_.time;
    begun_steps_ = run_.beat.steps;
    while (!finished_) {
      if (advance()) {
        observe();
        end_phase_when_due();
        keep_sometimes();
      }
      if (!finished_)
        housekeeping();
    }
    if (observers_.curves)
      observers_.curves(run_);
    count_time();
    return std::move(run_.beat);
  }

 private:
  void start() {
    model_.relax(loads_now().calcium);
    run_.steady = criterion(phase());
    record_curve();
  }

  bool resume();
  void save();
  void count_time();
  void keep();
  [[nodiscard]] bool advance();
  void keep_sometimes();
  void take_back(const std::string& why);
  void observe();
  void record_curve();
  void write_frame();
  [[nodiscard]] Snapshot snapshot() const;
  void watch_least_volume();
  void end_phase_when_due();
  [[nodiscard]] bool criterion_is_met() const;
  void end_phase(bool by_criterion);
  [[nodiscard]] Snapshot marked_wall() const;
  [[nodiscard]] const Phase& phase() const { return phases_[run_.phase]; }
  [[nodiscard]] double time_in_phase() const { return run_.time - run_.phase_start; }
  [[nodiscard]] bool loads_are_final() const { return time_in_phase() >= phase().settled; }
  [[nodiscard]] solid::Loads loads_now() const { return phase().loads(time_in_phase()); }
  void housekeeping();
  void report_progress(double now);
  [[nodiscard]] double time_left();

  const BeatSetup& setup_;
  std::filesystem::path folder_;
  const Observers& observers_;
  std::vector<Phase> phases_;
  immersed::Model model_;
  ImmersedSteps steps_;
  RunState run_;
  immersed::StepReport last_;
  bool finished_ = false;
  double volume_before_ = 0.0;

  std::optional<Moment> kept_;  ///< to go back to when a step fails

  Timer checkpoint_timer_;
  Timer progress_timer_{5.0};
  TimeLeft left_;
  double counted_until_ = wall_clock();
  double begun_time_ = 0.0;  ///< simulated and wall-clock time at which this process took over
  double begun_clock_ = wall_clock();
  int begun_steps_ = 0;
};

bool ImmersedRun::resume() {
  const std::filesystem::path file = folder_ / checkpoint_name;
  if (!parallel::any(parallel::is_root() && std::filesystem::exists(file)))
    return false;
  Checkpoint checkpoint = read_checkpoint(file, model_, phases_);
  model_.restore(checkpoint.now.model);
  run_ = std::move(checkpoint.now.run);
  kept_ = std::move(checkpoint.kept);
  log::info("resumed from the checkpoint at {:.4f} s of {}", run_.time, phase().name);
  return true;
}

void ImmersedRun::count_time() {
  const double now = wall_clock();
  run_.beat.wall_clock += now - counted_until_;
  counted_until_ = now;
}

void ImmersedRun::save() {
  count_time();
  Archive archive;
  archive.add("now", archived(model_.state(), run_, model_.transform()));
  archive.add("kept", archived(kept_->model, kept_->run, model_.transform()));
  if (parallel::is_root())
    archive.write(folder_ / checkpoint_name);
  parallel::barrier();
}

/// Remembers the present as a place to go back to.
void ImmersedRun::keep() {
  kept_ = {model_.state(), run_};
}

/// One step. False when it failed and the run went back.
bool ImmersedRun::advance() {
  const double dt = steps_.size(run_);
  volume_before_ = model_.cavity_volume();
  last_ = model_.step(loads_now(), dt, loads_are_final() ? phase().drag : 0.0);
  run_.time += dt;
  const std::string trouble = steps_.failure(last_, run_);
  if (trouble.empty())
    return true;
  take_back(trouble);
  return false;
}

void ImmersedRun::keep_sometimes() {
  constexpr int every = 200;  // steps
  if (run_.beat.steps % every == 0)
    keep();
}

void ImmersedRun::take_back(const std::string& why) {
  count_time();
  const RunState failed = std::move(run_);
  const std::string where = fmt::format("{:.4f} s of {}", failed.time, phases_[failed.phase].name);
  model_.restore(kept_->model);
  run_ = kept_->run;
  ImmersedSteps::go_back(failed, run_);
  if (steps_.gives_up(run_)) {
    save();
    throw steps_.unstable(where, why);
  }
  log::warn("at {:.4f} s {}; back to {:.4f} s with steps of {:.3g} s", failed.time, why, run_.time,
            steps_.size(run_));
}

Snapshot ImmersedRun::snapshot() const {
  const auto x = model_.positions();
  const auto tension = model_.contraction().tension();
  return {run_.time,
          loads_now().pressure,
          model_.cavity_volume(),
          {x.begin(), x.end()},
          {tension.begin(), tension.end()},
          {}};
}

void ImmersedRun::observe() {
  run_.steady.record(run_.time, model_.cavity_volume());
  if (phase().end == Phase::End::refilling)
    watch_least_volume();
  if (run_.time >= run_.next_curve)
    record_curve();
  if (run_.time >= run_.next_frame)
    write_frame();
}

void ImmersedRun::record_curve() {
  if (!run_.beat.curves.empty() && run_.beat.curves.back().time == run_.time)
    return;
  const auto motion =
      fluid::motion(model_.velocity(), setup_.model.grid, setup_.model.blood.density);
  const solid::Loads now = loads_now();
  run_.beat.curves.push_back({run_.time, phase().name, now.pressure, model_.cavity_volume(),
                              now.calcium, model_.mean_tension(), motion.kinetic_energy,
                              motion.largest_velocity, last_.J.min_J, last_.J.max_J,
                              steps_.size(run_)});
  run_.next_curve = run_.time + setup_.output.curve_interval;
}

void ImmersedRun::write_frame() {
  run_.next_frame = run_.time + setup_.output.frame_interval;
  const bool is_there = !run_.frame_times.empty() && run_.frame_times.back() == run_.time;
  if (!observers_.frame || is_there)
    return;
  const fluid::Component pressure = model_.pressure();
  const int number = run_.frames++;
  run_.frame_times.push_back(run_.time);
  observers_.frame({number, snapshot(), run_, Blood{model_, pressure}});
}

/// The smallest volume is noticed at the first step that fills again.
void ImmersedRun::watch_least_volume() {
  const bool falling = model_.cavity_volume() < volume_before_;
  if (run_.volume_was_falling && !falling &&
      (run_.least.positions.empty() || volume_before_ < run_.least.volume))
    run_.least = snapshot();
  run_.volume_was_falling = falling;
}

void ImmersedRun::end_phase_when_due() {
  const bool met = loads_are_final() && criterion_is_met();
  if (met || time_in_phase() >= phase().longest)
    end_phase(met);
}

bool ImmersedRun::criterion_is_met() const {
  if (phase().end == Phase::End::steady)
    return run_.steady.reached();
  constexpr double refilled = 1.02;  // of the smallest volume
  return !run_.least.positions.empty() && model_.cavity_volume() > refilled * run_.least.volume;
}

/// The wall at the moment that the phase ends with.
Snapshot ImmersedRun::marked_wall() const {
  const bool passed_the_least =
      !run_.least.positions.empty() && run_.least.volume < model_.cavity_volume();
  return passed_the_least ? run_.least : snapshot();
}

void ImmersedRun::end_phase(bool by_criterion) {
  record_curve();
  run_.beat.moments.push_back({phase().marks, phase().name, by_criterion, marked_wall()});
  const Snapshot& wall = run_.beat.moments.back().wall;
  if (!by_criterion)
    log::warn("{} did not meet its end criterion within {} s{}", phase().name, phase().longest,
              std::isfinite(run_.steady.variation())
                  ? fmt::format(": the volume still varies by {:.2g}% per {} s",
                                100.0 * run_.steady.variation(), phase().window)
                  : "");
  log::info("{} at {:.4f} s: {:.2f} ml at {:.1f} mmHg", title(phase().marks), wall.time,
            1e-3 * wall.volume, wall.pressure / mmHg);
  write_frame();
  if (run_.phase + 1 == phases_.size()) {
    finished_ = true;
    return;
  }
  ++run_.phase;
  run_.phase_start = run_.time;
  run_.steady = criterion(phase());
  run_.least = {};
  run_.volume_was_falling = false;
  keep();
}

void ImmersedRun::housekeeping() {
  if (parallel::any(interrupt::requested())) {
    save();
    if (observers_.curves)
      observers_.curves(run_);
    throw Interrupted(fmt::format("stopped at {:.4f} s of {}; run the same command again to go on",
                                  run_.time, phase().name));
  }
  constexpr int look_every = 10;  // steps
  if (run_.beat.steps % look_every != 0)
    return;
  const double now = wall_clock();
  if (checkpoint_timer_.due(now))
    save();
  if (progress_timer_.due(now)) {
    report_progress(now);
    if (observers_.curves)
      observers_.curves(run_);
  }
}

/// Simulated time that the run will probably still take.
double ImmersedRun::time_left() {
  const std::vector<Phase> expected = phases_of_wall(phases_, run_.beat);
  double left = settling_time_left(expected[run_.phase], time_in_phase(), run_.steady);
  for (std::size_t next = run_.phase + 1; next < expected.size(); ++next)
    left += expected[next].usual;
  return left;
}

void ImmersedRun::report_progress(double now) {
  left_.record(run_.time - begun_time_);
  const double rate = (run_.beat.steps - begun_steps_) / (now - begun_clock_);
  log::info(
      "{} {:.3f} s  {:.1f} mmHg  {:.1f} ml  tension {:.1f} kPa  local volume {:.2f} to {:.2f}  "
      "{:.1f} steps/s{}",
      phase().name, run_.time, loads_now().pressure / mmHg, 1e-3 * model_.cavity_volume(),
      model_.mean_tension(), last_.J.min_J, last_.J.max_J, rate, left_.words(time_left()));
}

}  // namespace

Beat run_immersed_beat(const BeatSetup& setup, const std::filesystem::path& folder,
                       const Observers& observers) {
  return ImmersedRun(setup, folder, observers).run();
}

}  // namespace lv::heartbeat
