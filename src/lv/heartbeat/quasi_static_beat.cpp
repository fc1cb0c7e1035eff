#include "lv/heartbeat/quasi_static_beat.hpp"

#include "lv/base/log.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace lv::heartbeat {
namespace {

using quasi_static::Engine;
using quasi_static::Step;
using solid::Loads;
using units::mmHg;

/// Steps short enough for curves: contraction begins steeply.
quasi_static::SolverParameters smooth(quasi_static::SolverParameters p) {
  constexpr double first_step = 0.02;
  constexpr double largest_change = 0.05;
  p.first_step = std::min(p.first_step, first_step);
  p.largest_change = largest_change;
  return p;
}

class QuasiStaticRun {
 public:
  QuasiStaticRun(const QuasiStaticSetup& setup, const Observers& observers)
      : setup_(setup),
        observers_(observers),
        engine_(setup.mesh, setup.model, smooth(setup.parameters)) {
    record({engine_.loads(), 0.0, 0.0, engine_.cavity_volume(), {}});
  }

  Beat run() {
    const auto start = std::chrono::steady_clock::now();
    const Protocol& p = setup_.protocol;
    go_to({p.ed_pressure, 0.0});
    run_.beat.end_diastole = state();
    run_.phase = Phase::contraction;
    steps_before_ = run_.beat.steps;
    run_.phase_start = p.filling_ramp;
    go_to({p.es_pressure, 1.0});
    run_.beat.end_systole = state();
    run_.beat.filling_was_steady = run_.beat.contraction_was_steady = true;
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
    const quasi_static::NewtonReport& n = step.newton;
    left_.record(run_.beat.steps);
    log::info("{} {:3.0f}%  {:.2f} mmHg  {:.2f} ml  tension {:.1f} kPa  {} corrections, {} {}{}{}",
              name(run_.phase), 100.0 * step.progress, step.loads.pressure / mmHg,
              1e-3 * step.volume, run_.beat.curves.back().mean_tension, n.iterations,
              n.factorisations, n.factorisations == 1 ? "tangent" : "tangents",
              n.linear_iterations == 0
                  ? ""
                  : fmt::format(", {} iterations of GMRES", n.linear_iterations),
              left_.words(steps_left(step)));
  }

  /// Load steps that the beat will probably still take: of this phase what is left of the usual
  /// number, or steps that grow from the last one if those are more; and those of contraction.
  [[nodiscard]] double steps_left(const Step& step) const {
    if (step.progress >= 1.0)
      return run_.phase == Phase::filling ? usual_contraction : 0.0;
    const double in_lengths = (1.0 - step.progress) / step.length;
    const double growing = std::log(1.0 + (growth - 1.0) * in_lengths) / std::log(growth);
    const bool is_filling = run_.phase == Phase::filling;
    const double usual = is_filling ? usual_filling : usual_contraction;
    return std::max(growing, usual - (run_.beat.steps - steps_before_)) +
           (is_filling ? usual_contraction : 0.0);
  }

  void record(const Step& step) {
    const Protocol& p = setup_.protocol;
    const double ramp = run_.phase == Phase::filling ? p.filling_ramp : p.contraction_ramp;
    run_.time = run_.phase_start + step.progress * ramp;
    CurveRow row;
    row.time = run_.time;
    row.phase = run_.phase;
    row.pressure = step.loads.pressure;
    row.volume = step.volume;
    row.calcium = calcium(step.loads.activation);
    row.mean_tension = engine_.mean_tension();
    row.step = step.length * ramp;
    row.min_J = row.max_J = std::numeric_limits<double>::quiet_NaN();  // not looked at
    run_.beat.curves.push_back(row);
    if (observers_.curves)
      observers_.curves(run_);
    constexpr double nearly = 1e-9;  // of the way
    const bool is_end = step.progress == 0.0 || step.progress > 1.0 - nearly;
    const bool has_moved =
        std::abs(step.volume - last_frame_volume_) > frame_change * last_frame_volume_;
    if (!observers_.frame || (!is_end && !has_moved && run_.time < run_.next_frame))
      return;
    run_.next_frame = run_.time + setup_.frame_interval;
    last_frame_volume_ = step.volume;
    const int number = run_.frames++;
    run_.frame_times.push_back(run_.time);
    observers_.frame({number, state(), run_, {}});
  }

  /// Known where the muscle rests or is fully active; in between the tension is a mean of both.
  [[nodiscard]] double calcium(double activation) const {
    const auto& c = setup_.protocol.calcium;
    return activation == 0.0   ? c.Ca_0
           : activation == 1.0 ? c.Ca_max
                               : std::numeric_limits<double>::quiet_NaN();
  }

  /// The engine's present state.
  [[nodiscard]] Snapshot state() const {
    Snapshot s;
    s.time = run_.time;
    s.phase = run_.phase;
    s.pressure = engine_.loads().pressure;
    s.volume = engine_.cavity_volume();
    s.positions = engine_.state().positions;
    s.stress = engine_.equations().cell_stress(engine_.state(), engine_.loads().activation);
    return s;
  }

  static constexpr double usual_filling = 22.0;      ///< load steps
  static constexpr double usual_contraction = 24.0;  ///< load steps
  static constexpr double growth = 1.5;              ///< of a step from the one before it
  static constexpr double frame_change = 0.1;        ///< of the volume since the last frame

  const QuasiStaticSetup& setup_;
  const Observers& observers_;
  Engine engine_;
  RunState run_;
  TimeLeft left_;
  int steps_before_ = 0;            ///< of the phases before this one
  double last_frame_volume_ = 0.0;  ///< [mm^3]
};

}  // namespace

Beat run_quasi_static_beat(const QuasiStaticSetup& setup, const Observers& observers) {
  return QuasiStaticRun(setup, observers).run();
}

}  // namespace lv::heartbeat
