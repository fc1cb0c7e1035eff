#include "lv/implicit/time_engine.hpp"

#include "lv/base/check.hpp"
#include "lv/base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace lv::implicit {

namespace {

/// The value at a step's end of what has the value `now` at its start and `then` at a share of it.
template <class T>
T at_end(const T& now, const T& then, double share) {
  return now + (then - now) / share;
}

}  // namespace

TimeEngine::TimeEngine(const mesh::Mesh& mesh, const StaticModel& model,
                       const SolverParameters& parameters, double spectral_radius)
    : engine_(mesh, model, parameters),
      muscle_(model.heart.myocardium.active,
              engine_.equations().own_elements() * engine_.equations().points_per_element(),
              engine_.equations().contractility()),
      has_rates_(model.has_rates()),
      has_inertia_(model.density > 0.0),
      rule_(GeneralisedAlpha::of_radius(spectral_radius)) {
  rest();
}

void TimeEngine::rest() {
  dt_before_ = 0.0;
  if (has_rates_)
    rates_.velocity.assign(engine_.state().positions.size(), Vec3::Zero());
  if (has_inertia_)
    rates_.acceleration = rates_.velocity;
}

Outcome<double> TimeEngine::fill(double pressure, double Ca_0, const solid::AffineField& base) {
  engine_.relax();
  auto volume = engine_.go_to({pressure});
  if (!volume)
    return volume;
  const TensionAt none = [](std::size_t, std::size_t, double) { return Tension{}; };
  if (const NewtonReport report = carry({none, pressure}, base); !report.converged)
    return Unsolved{"the filled wall finds no equilibrium without tension: " + report.why,
                    "Take a resting calcium (calcium.Ca_0) with less tension"};
  State filled = engine_.state();
  filled.cavity_pressure = pressure;
  engine_.restore(filled, engine_.loads());
  muscle_.relax(Ca_0, engine_.equations().fibre_stretch(filled));
  rest();
  return cavity_volume();
}

/// The equilibrium with the base at a place, by steps that move it little.
NewtonReport TimeEngine::carry(const Equilibrium& filled, const solid::AffineField& base) {
  constexpr double little = 2.0;  // [mm]
  double farthest = 0.0;
  for (const Vec3& X : engine_.equations().undeformed())
    farthest = std::max(farthest, base.at(X).norm());
  const int steps = std::max(1, static_cast<int>(std::ceil(farthest / little)));
  Equilibrium there = filled;
  NewtonReport report;
  for (int n = 1; n <= steps; ++n) {
    there.base.displacement = solid::between({}, base, static_cast<double>(n) / steps);
    State guess = engine_.state();
    for (std::size_t a = 0; a < guess.positions.size(); ++a)
      guess.positions[a] += base.at(engine_.equations().undeformed()[a]) / steps;
    report = engine_.find(std::move(guess), there);
    if (!report.converged)
      return report;
  }
  base_ = there.base;
  return report;
}

NewtonReport TimeEngine::advance(const TimeStep& step, const VolumeOfPressure& volume) {
  if (has_rates_)
    return advance_with_rates(step, volume);
  const State now = engine_.state();
  const State guess = dt_before_ > 0.0 ? extrapolate(before_, now, step.dt / dt_before_) : now;
  const Equilibrium end{tension_after(step), 0.0, volume, nullptr, step.base.at(1.0, step.dt)};
  NewtonReport report = engine_.find(guess, end);
  if (!report.converged && dt_before_ > 0.0)
    report = engine_.find(now, end);
  if (!report.converged) {
    dt_before_ = 0.0;
    return report;
  }
  muscle_.advance(step, engine_.equations().fibre_stretch(engine_.state()));
  base_ = end.base;
  before_ = now;
  dt_before_ = step.dt;
  return report;
}

void TimeEngine::go_back(const Passed& begin) {
  engine_.place(begin.state);
  muscle_ = begin.muscle;
  rates_ = begin.rates;
  base_ = begin.base;
  dt_before_ = 0.0;  // nothing to extrapolate from
}

bool TimeEngine::give_way(const TimeStep& step, const VolumeOfPressure& volume) {
  const solid::BasePlace base = step.base.at(1.0, step.dt);
  if (has_rates_ || !engine_.give_way({tension_after(step), 0.0, volume, nullptr, base}))
    return false;
  muscle_.advance(step, engine_.equations().fibre_stretch(engine_.state()));
  base_ = base;
  dt_before_ = 0.0;  // nothing to extrapolate from
  return true;
}

TensionAt TimeEngine::tension_after(const TimeStep& step) const {
  return [this, &step](std::size_t element, std::size_t point, double stretch) {
    return muscle_.after(step, point_number(element, point), stretch);
  };
}

NewtonReport TimeEngine::advance_with_rates(const TimeStep& step, const VolumeOfPressure& volume) {
  const double share = balance();
  const std::vector<double> stretch_now = engine_.equations().fibre_stretch(state());
  const double pressure_now = pressure();
  const double volume_now = cavity_volume();
  const TensionAt tension = [&](std::size_t element, std::size_t point, double stretch) {
    const std::size_t i = point_number(element, point);
    Tension T = muscle_.after(step, i, at_end(stretch_now[i], stretch, share));
    T.value = share * T.value + (1.0 - share) * muscle_.now(i).value;
    return T;  // its slope by the stretch at balance is that at the end by the stretch there
  };
  const auto at_balance = [&](double p) {
    GivenVolume given = volume(at_end(pressure_now, p, share));
    given.volume = share * given.volume + (1.0 - share) * volume_now;
    return given;
  };
  NewtonReport report =
      move(step.dt, {tension, 0.0, at_balance, nullptr, step.base.at(share, step.dt)});
  if (report.converged) {
    muscle_.advance(step, engine_.equations().fibre_stretch(state()));
    base_ = step.base.at(1.0, step.dt);
  }
  return report;
}

NewtonReport TimeEngine::move(double dt, Equilibrium at_balance) {
  LV_CHECK(has_rates_);
  const State now = engine_.state();
  if (dt != dt_before_)
    engine_.forget_tangent();
  const Motion motion = motion_in_step(rule_, dt, now.positions, rates_);
  at_balance.motion = &motion;
  NewtonReport report = engine_.find(predicted(now, dt), at_balance);
  if (!report.converged)
    report = engine_.find(now, at_balance);
  if (!report.converged) {
    dt_before_ = 0.0;
    return report;
  }
  State end = engine_.state();
  for (std::size_t a = 0; a < end.positions.size(); ++a)
    end.positions[a] = at_end(now.positions[a], end.positions[a], balance());
  end.cavity_pressure = at_balance.volume
                            ? at_end(now.cavity_pressure, end.cavity_pressure, balance())
                            : at_balance.pressure;
  rates_ = rates_after(rule_, dt, now.positions, rates_, end.positions);
  engine_.place(std::move(end));
  before_ = now;
  dt_before_ = dt;
  return report;
}

/// Where the rates lead, at the moment of balance.
State TimeEngine::predicted(const State& now, double dt) const {
  const State straight =
      dt_before_ > 0.0 ? extrapolate(before_, now, balance() * dt / dt_before_) : now;
  State guess = straight;
  for (std::size_t a = 0; a < guess.positions.size(); ++a) {
    Vec3 step = dt * rates_.velocity[a];
    if (has_inertia_)
      step += 0.5 * dt * dt * rates_.acceleration[a];
    guess.positions[a] = now.positions[a] + balance() * step;
  }
  return guess;
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

TimeEngine::Work TimeEngine::work_since(const Passed& before) const {
  const Equations& equations = engine_.equations();
  const TensionAt then = tension_of(before.muscle);
  const TensionAt now = tension_of(muscle_);
  const Equations::Moving from{before.state.positions, before.rates.velocity, before.base};
  const Equations::Moving to{state().positions, rates_.velocity, base_};
  return {equations.pressure_work(before.state, state()),
          equations.muscle_work({before.state, then}, {state(), now}),
          equations.support_work(from, to), equations.viscous_work(from, to),
          equations.base_work(from, to)};
}

std::size_t TimeEngine::muscle_numbers() const {
  return muscle_.numbers_per_point() * engine_.equations().points_per_element() *
         engine_.equations().elements();
}

TimeEngine::Moment TimeEngine::moment() {
  const std::span<const int> own = engine_.equations().own();
  const std::size_t width = muscle_.numbers_per_point() * engine_.equations().points_per_element();
  const std::vector<double> mine = muscle_.numbers();
  Moment moment{engine_.state(),
                before_,
                dt_before_,
                rates_,
                std::vector<double>(muscle_numbers(), 0.0),
                base_};
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
  rates_ = moment.rates;
  base_ = moment.base;
  before_ = moment.before;
  dt_before_ = moment.dt_before;
}

}  // namespace lv::implicit
