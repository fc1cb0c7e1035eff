#include "lv/quasi_static/time_engine.hpp"

#include "lv/base/parallel.hpp"

#include <algorithm>

namespace lv::quasi_static {

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

TensionAt TimeEngine::tension_now() const {
  return [this](std::size_t element, std::size_t point, double) {
    return muscle_.now(point_number(element, point));
  };
}

double TimeEngine::mean_tension() const {
  return engine_.equations().mean_tension(state(), tension_now());
}

std::vector<solid::CellStress> TimeEngine::cell_stress() const {
  return engine_.equations().cell_stress(state(), tension_now());
}

std::size_t TimeEngine::numbers_per_element() const {
  return engine_.equations().points_per_element() * muscle_.numbers_per_point();
}

std::vector<double> TimeEngine::muscle() const {
  const Equations& equations = engine_.equations();
  const std::size_t each = numbers_per_element();
  const std::vector<double> own = muscle_.numbers();
  std::vector<double> all(equations.element_count() * each, 0.0);
  for (std::size_t e = 0; e < equations.own_elements(); ++e)
    std::copy_n(own.begin() + static_cast<std::ptrdiff_t>(e * each), each,
                all.begin() + static_cast<std::ptrdiff_t>(equations.element_number(e) * each));
  parallel::sum(all);
  return all;
}

void TimeEngine::restore(const State& state, std::span<const double> muscle) {
  const Equations& equations = engine_.equations();
  const std::size_t each = numbers_per_element();
  engine_.restore(state, {state.cavity_pressure});
  std::vector<double> own;
  for (std::size_t e = 0; e < equations.own_elements(); ++e) {
    const auto numbers = muscle.subspan(equations.element_number(e) * each, each);
    own.insert(own.end(), numbers.begin(), numbers.end());
  }
  muscle_.set_numbers(own);
  dt_before_ = 0.0;
}

void TimeEngine::forget_past() {
  engine_.forget_tangent();
  dt_before_ = 0.0;
}

}  // namespace lv::quasi_static
