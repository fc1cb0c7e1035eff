#include "lv/heartbeat/quasi_static_beat.hpp"

#include "lv/base/log.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"

#include <chrono>
#include <cmath>
#include <limits>

namespace lv::heartbeat {
namespace {

using quasi_static::Engine;
using quasi_static::Step;
using solid::Loads;
using units::mmHg;

class QuasiStaticRun {
 public:
  QuasiStaticRun(const QuasiStaticSetup& setup, const Observers& observers)
      : setup_(setup), observers_(observers), engine_(setup.mesh, setup.model, setup.parameters) {
    record({engine_.loads(), 0.0, 0.0, engine_.cavity_volume(), {}});
  }

  Beat run() {
    const auto start = std::chrono::steady_clock::now();
    const Protocol& p = setup_.protocol;
    go_to({p.ed_pressure, 0.0});
    run_.beat.end_diastole = state();
    run_.phase = Phase::contraction;
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

  /// Load steps that the beat will probably still take: those of this phase at the length of the
  /// last one, and those that contraction usually takes.
  [[nodiscard]] double steps_left(const Step& step) const {
    const double here = std::ceil((1.0 - step.progress) / step.length - 1e-9);
    return run_.phase == Phase::filling ? here + usual_contraction : here;
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
    if (!observers_.frame || (!is_end && run_.time < run_.next_frame))
      return;
    run_.next_frame = run_.time + setup_.frame_interval;
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

  static constexpr double usual_contraction = 12.0;  ///< load steps

  const QuasiStaticSetup& setup_;
  const Observers& observers_;
  Engine engine_;
  RunState run_;
  TimeLeft left_;
};

}  // namespace

Beat run_quasi_static_beat(const QuasiStaticSetup& setup, const Observers& observers) {
  return QuasiStaticRun(setup, observers).run();
}

}  // namespace lv::heartbeat
