#include "lv/heartbeat/quasi_static_beat.hpp"

#include "lv/base/log.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/heartbeat/step_forecast.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace lv::heartbeat {
namespace {

using implicit::Engine;
using implicit::Step;
using solid::Loads;
using units::mmHg;

/// Steps short enough for curves: contraction begins steeply.
implicit::SolverParameters smooth(implicit::SolverParameters p) {
  constexpr double first_step = 0.002;
  constexpr double largest_change = 0.05;
  p.first_step = std::min(p.first_step, first_step);
  p.largest_change = largest_change;
  return p;
}

std::vector<StepForecast::Kind> kinds(const std::vector<Phase>& phases) {
  std::vector<StepForecast::Kind> all;
  for (const Phase& phase : phases)
    all.push_back(phase.loads(phase.settled).activation > 0.0 ? StepForecast::Kind::contraction
                                                              : StepForecast::Kind::filling);
  return all;
}

class QuasiStaticRun {
 public:
  QuasiStaticRun(const QuasiStaticSetup& setup, const Observers& observers)
      : setup_(setup),
        observers_(observers),
        phases_(phases(setup.protocol)),
        engine_(setup.mesh, setup.model, smooth(setup.parameters)),
        forecast_(kinds(phases_)) {
    record({phase().loads(0.0), 0.0, 0.0, engine_.cavity_volume(), {}});
  }

  Beat run() {
    const auto start = std::chrono::steady_clock::now();
    last_step_ = start;
    for (run_.phase = 0; run_.phase < phases_.size(); ++run_.phase) {
      forecast_.begin();
      go_to(final_loads());
      run_.beat.moments.push_back({phase().marks, phase().name, true, state()});
      run_.phase_start += phase().ramp;
    }
    if (observers_.curves)
      observers_.curves(run_);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    run_.beat.wall_clock = elapsed.count();
    return std::move(run_.beat);
  }

 private:
  void go_to(const Loads& loads) {
    const auto follow = [&](const Step& step) {
      ++run_.beat.steps;
      record(step);
      report_progress(step);
    };
    engine_.go_to(loads, follow).value();
  }

  void report_progress(const Step& step) {
    const implicit::NewtonReport& n = step.newton;
    const auto now = std::chrono::steady_clock::now();
    forecast_.record(std::chrono::duration<double>(now - last_step_).count(), step.progress);
    last_step_ = now;
    log::info("{} {:3.0f}%  {:.2f} mmHg  {:.2f} ml  tension {:.1f} kPa  {} corrections, {} {}{}{}",
              phase().name, 100.0 * step.progress, step.loads.pressure / mmHg, 1e-3 * step.volume,
              run_.beat.curves.back().mean_tension, n.iterations, n.factorisations,
              n.factorisations == 1 ? "tangent" : "tangents",
              n.linear_iterations == 0
                  ? ""
                  : fmt::format(", {} iterations of GMRES", n.linear_iterations),
              time_left(forecast_.seconds_left()));
  }

  void record(const Step& step) {
    run_.time = run_.phase_start + step.progress * phase().ramp;
    CurveRow row;
    row.time = run_.time;
    row.phase = phase().name;
    row.pressure = step.loads.pressure;
    row.volume = step.volume;
    row.calcium = calcium(step);
    row.mean_tension = engine_.mean_tension();
    row.step = step.length * phase().ramp;
    row.min_J = row.max_J = std::numeric_limits<double>::quiet_NaN();  // not looked at
    run_.beat.curves.push_back(row);
    if (observers_.curves)
      observers_.curves(run_);
    const bool has_moved =
        std::abs(step.volume - last_frame_volume_) > frame_change * last_frame_volume_;
    if (!observers_.frame || (!is_end(step) && !has_moved && run_.time < run_.next_frame))
      return;
    run_.next_frame = run_.time + setup_.frame_interval;
    last_frame_volume_ = step.volume;
    const int number = run_.frames++;
    run_.frame_times.push_back(run_.time);
    observers_.frame({number, state(), run_, {}});
  }

  [[nodiscard]] const Phase& phase() const { return phases_[run_.phase]; }
  [[nodiscard]] Loads final_loads() const { return phase().loads(phase().settled); }

  [[nodiscard]] static bool is_end(const Step& step) {
    constexpr double nearly = 1e-9;  // of the way
    return step.progress == 0.0 || step.progress > 1.0 - nearly;
  }

  /// Known at the ends of the phase, and where they are alike: in between the tension is a mean.
  [[nodiscard]] double calcium(const Step& step) const {
    const double first = phase().loads(0.0).calcium;
    const double last = final_loads().calcium;
    if (step.progress == 0.0 || first == last)
      return first;
    return is_end(step) ? last : std::numeric_limits<double>::quiet_NaN();
  }

  /// The engine's present state.
  [[nodiscard]] Snapshot state() const {
    Snapshot s;
    s.time = run_.time;
    s.pressure = engine_.loads().pressure;
    s.volume = engine_.cavity_volume();
    s.positions = engine_.state().positions;
    s.stress = engine_.cell_stress();
    return s;
  }

  static constexpr double frame_change = 0.1;  ///< of the volume since the last frame

  const QuasiStaticSetup& setup_;
  const Observers& observers_;
  std::vector<Phase> phases_;
  Engine engine_;
  RunState run_;
  StepForecast forecast_;
  std::chrono::steady_clock::time_point last_step_;
  double last_frame_volume_ = 0.0;  ///< [mm^3]
};

}  // namespace

Beat run_quasi_static_beat(const QuasiStaticSetup& setup, const Observers& observers) {
  return QuasiStaticRun(setup, observers).run();
}

}  // namespace lv::heartbeat
