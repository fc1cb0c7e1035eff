#include "lv/heartbeat/quasi_static_beat.hpp"

#include "lv/base/log.hpp"
#include "lv/base/units.hpp"

#include <chrono>
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
    for (run_.phase = 0; run_.phase < phases_.size(); ++run_.phase) {
      go_to(phase().loads(phase().settled));
      run_.beat.moments.push_back({phase().marks, phase().name, true, state()});
      run_.phase_start += phase().ramp;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    run_.beat.wall_clock = elapsed.count();
    return std::move(run_.beat);
  }

 private:
  void go_to(const Loads& loads) {
    const auto follow = [&](const Step& step) {
      ++run_.beat.steps;
      record(step);
      log::info("{} {:3.0f}%  {:.2f} mmHg  {:.2f} ml  T {:.1f} kPa  {} corrections, {} {}{}",
                phase().name, 100.0 * step.progress, step.loads.pressure / mmHg, 1e-3 * step.volume,
                run_.beat.curves.back().mean_tension, step.newton.iterations,
                step.newton.factorisations,
                step.newton.factorisations == 1 ? "tangent" : "tangents",
                step.newton.linear_iterations == 0
                    ? ""
                    : fmt::format(", {} iterations of GMRES", step.newton.linear_iterations));
    };
    engine_.go_to(loads, follow).value();
  }

  void record(const Step& step) {
    constexpr double nearly = 1e-9;  // of the way
    const bool is_end = step.progress == 0.0 || step.progress > 1.0 - nearly;
    run_.time = run_.phase_start + step.progress * phase().ramp;
    CurveRow row;
    row.time = run_.time;
    row.phase = phase().name;
    row.pressure = step.loads.pressure;
    row.volume = step.volume;
    // in between the tension is a mean of both ends
    row.calcium = is_end ? step.loads.calcium : std::numeric_limits<double>::quiet_NaN();
    row.mean_tension = engine_.mean_tension();
    row.step = step.length * phase().ramp;
    row.min_J = row.max_J = std::numeric_limits<double>::quiet_NaN();  // not looked at
    run_.beat.curves.push_back(row);
    if (observers_.curves)
      observers_.curves(run_);
    if (!observers_.frame || (!is_end && run_.time < run_.next_frame))
      return;
    run_.next_frame = run_.time + setup_.frame_interval;
    const int number = run_.frames++;
    run_.frame_times.push_back(run_.time);
    observers_.frame({number, state(), run_, {}});
  }

  [[nodiscard]] const Phase& phase() const { return phases_[run_.phase]; }

  /// The engine's present state.
  [[nodiscard]] Snapshot state() const {
    Snapshot s;
    s.time = run_.time;
    s.pressure = engine_.loads().pressure;
    s.volume = engine_.cavity_volume();
    s.positions = engine_.state().positions;
    s.stress = engine_.equations().cell_stress(engine_.state(), engine_.loads().activation);
    return s;
  }

  const QuasiStaticSetup& setup_;
  const Observers& observers_;
  std::vector<Phase> phases_;
  Engine engine_;
  RunState run_;
};

}  // namespace

Beat run_quasi_static_beat(const QuasiStaticSetup& setup, const Observers& observers) {
  return QuasiStaticRun(setup, observers).run();
}

}  // namespace lv::heartbeat
