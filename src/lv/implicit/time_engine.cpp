#include "lv/implicit/time_engine.hpp"

namespace lv::implicit {

TimeEngine::TimeEngine(const mesh::Mesh& mesh, const StaticModel& model,
                       const SolverParameters& parameters)
    : engine_(mesh, model, parameters),
      muscle_(model.heart.myocardium.active,
              engine_.equations().own_elements() * engine_.equations().points_per_element()) {}

Outcome<double> TimeEngine::fill(double pressure, double Ca_0) {
  engine_.relax();
  auto volume = engine_.go_to({pressure});
  if (!volume)
    return volume;
  State filled = engine_.state();
  filled.cavity_pressure = pressure;
  engine_.restore(filled, engine_.loads());
  muscle_.relax(Ca_0, engine_.equations().fibre_stretch(filled));
  dt_before_ = 0.0;
  return volume;
}

NewtonReport TimeEngine::advance(const TimeStep& step, const VolumeOfPressure& volume) {
  const State now = engine_.state();
  const State guess = dt_before_ > 0.0 ? extrapolate(before_, now, step.dt / dt_before_) : now;
  const TensionAt tension = [&](std::size_t element, std::size_t point, double stretch) {
    return muscle_.after(step, point_number(element, point), stretch);
  };
  NewtonReport report = engine_.find(guess, {tension, 0.0, volume});
  if (!report.converged && dt_before_ > 0.0)
    report = engine_.find(now, {tension, 0.0, volume});
  if (!report.converged) {
    dt_before_ = 0.0;
    return report;
  }
  muscle_.advance(step, engine_.equations().fibre_stretch(engine_.state()));
  before_ = now;
  dt_before_ = step.dt;
  return report;
}

}  // namespace lv::implicit
