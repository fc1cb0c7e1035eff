#include "lv/implicit/time_engine.hpp"

#include "lv/base/parallel.hpp"

#include <algorithm>

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

TensionAt TimeEngine::tension_of(const Muscle& muscle) const {
  return [this, &muscle](std::size_t element, std::size_t point, double) {
    return muscle.now(point_number(element, point));
  };
}

std::vector<solid::CellStress> TimeEngine::cell_stress(const Passed& at) const {
  return engine_.equations().cell_stress(at.state, tension_of(at.muscle));
}

double TimeEngine::mean_tension() const {
  return engine_.equations().mean_tension(engine_.state(), tension_of(muscle_));
}

double TimeEngine::muscle_work_since(const Passed& before) const {
  const TensionAt then = tension_of(before.muscle);
  const TensionAt now = tension_of(muscle_);
  return engine_.equations().muscle_work({before.state, then}, {engine_.state(), now});
}

std::size_t TimeEngine::muscle_numbers() const {
  return muscle_.numbers_per_point() * engine_.equations().points_per_element() *
         engine_.equations().elements();
}

TimeEngine::Moment TimeEngine::moment() {
  const std::span<const int> own = engine_.equations().own();
  const std::size_t width = muscle_.numbers_per_point() * engine_.equations().points_per_element();
  const std::vector<double> mine = muscle_.numbers();
  Moment moment{engine_.state(), before_, dt_before_, std::vector<double>(muscle_numbers(), 0.0)};
  for (std::size_t i = 0; i < own.size(); ++i)
    std::copy_n(mine.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                moment.muscle.begin() + static_cast<std::ptrdiff_t>(own[i] * width));
  parallel::sum(moment.muscle);
  engine_.begin_anew();
  return moment;
}

void TimeEngine::restore(const Moment& moment) {
  const std::span<const int> own = engine_.equations().own();
  const std::size_t width = muscle_.numbers_per_point() * engine_.equations().points_per_element();
  std::vector<double> mine;
  for (const int e : own) {
    const auto from = moment.muscle.begin() + static_cast<std::ptrdiff_t>(e * width);
    mine.insert(mine.end(), from, from + static_cast<std::ptrdiff_t>(width));
  }
  muscle_.set_numbers(mine);
  engine_.restore(moment.now, {moment.now.cavity_pressure});
  engine_.begin_anew();
  before_ = moment.before;
  dt_before_ = moment.dt_before;
}

}  // namespace lv::implicit
