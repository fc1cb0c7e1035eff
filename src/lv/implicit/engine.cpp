#include "lv/implicit/engine.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/implicit/give_way.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lv::implicit {
namespace {

/// Step lengths grow when Newton's method finds it easy, and shrink when it does not.
constexpr int easy = 5;  // corrections
constexpr int hard = 12;
constexpr double growth = 1.7;

/// By which share of the way a wall goes on that gives way, and how often it may.
constexpr double leap = 0.02;
constexpr int most_leaps = 5;

double next_length(double length, int corrections) {
  return corrections <= easy ? length * growth : corrections >= hard ? length / growth : length;
}

/// How a path ended, and where it turned the last time.
std::string words(const Path& path, const WayOfLoads& way) {
  std::string text =
      path.arrived ? "leads to all of the loads" : fmt::format("ends ({})", path.why);
  if (path.turns.empty())
    return text + " without a turn";
  const Turn& turn = path.turns.back();
  const Loads loads = way.at(turn.share);
  return text + fmt::format(
                    ", and turns at {:.2f} mmHg and {:.1f}% of the active tension, where the wall "
                    "moves most near ({:.0f}, {:.0f}, {:.0f}) mm ({:.2g}% of its nodes)",
                    loads.pressure / units::mmHg, 100.0 * loads.activation, turn.place.x(),
                    turn.place.y(), turn.place.z(), 100.0 * turn.width);
}

Unsolved no_farther(const Loads& loads, const std::string& why) {
  return {fmt::format("No equilibrium was found beyond {:.2f} mmHg and {:.0f}% of the active "
                      "tension: {}",
                      loads.pressure / units::mmHg, 100.0 * loads.activation, why),
          loads.activation > 0.0
              ? "The muscle may contract more than its wall can follow, or less than the pressure "
                "asks for: look at active.T_scale and at the mesh's worst element; try a finer "
                "mesh, or a smaller quasi_static.first_step"
              : "Look at the mesh's worst element and at the stiffness (a wall too soft for its "
                "pressure has no equilibrium); try a finer mesh, or a smaller "
                "quasi_static.first_step"};
}

}  // namespace

State extrapolate(const State& before, const State& now, double by) {
  State next = now;
  for (std::size_t a = 0; a < next.positions.size(); ++a)
    next.positions[a] += by * (now.positions[a] - before.positions[a]);
  for (std::size_t m = 0; m < next.pressures.size(); ++m)
    next.pressures[m] += by * (now.pressures[m] - before.pressures[m]);
  next.cavity_pressure += by * (now.cavity_pressure - before.cavity_pressure);
  return next;
}

Engine::Engine(const mesh::Mesh& mesh, const StaticModel& model, const SolverParameters& parameters)
    : parameters_(parameters),
      equations_(mesh, model),
      newton_(equations_, parameters.newton),
      state_(equations_.rest()) {}

Outcome<double> Engine::go_to(const Loads& target,
                              const std::function<void(const Step&)>& observe) {
  const WayOfLoads way{loads_, target};
  double volume = cavity_volume();
  const double most = parameters_.largest_change * volume;  // [mm^3]
  std::optional<State> before;
  double last_length = 0.0;
  double length = parameters_.first_step;
  double progress = 0.0;
  int leaps = 0;
  TimeLeft quiet;
  while (progress < 1.0) {
    length = std::min(length, 1.0 - progress);
    if (1.0 - progress - length < 0.1 * length)
      length = 1.0 - progress;  // no crumbs
    Loads loads = way.at(progress + length);
    State next = before ? extrapolate(*before, state_, length / last_length) : state_;
    NewtonReport report = newton_.solve(next, loads);
    if (!report.converged) {
      log::info("a step of {:.3g} of the way failed: {}", length, report.why);
      if (before) {
        before.reset();  // once more without extrapolation
        length *= 0.5;
      } else {
        length *= 0.25;
      }
      if (length >= parameters_.smallest_step)
        continue;
      if (hold_firmly()) {
        length = parameters_.first_step;
        continue;
      }
      next = state_;
      const auto farther = get_over({way, progress, leaps++ < most_leaps, report.why}, next);
      if (!farther)
        return farther.why();
      length = *farther;
      loads = way.at(progress + length);
      report.converged = true;
      state_ = next;  // nothing to extrapolate from
    }
    before = std::move(state_);
    state_ = std::move(next);
    loads_ = loads;
    progress = progress + length;
    last_length = length;
    const double now = cavity_volume();
    const double change = std::abs(now - volume);
    volume = now;
    if (observe)
      observe({loads_, progress, length, volume, report});
    else if (progress < 1.0 && quiet.due())
      log::info("{:.0f}% of the way to {:.2f} mmHg and {:.0f}% of the active tension",
                100.0 * progress, target.pressure / units::mmHg, 100.0 * target.activation);
    length = std::min(next_length(length, report.iterations), length * most / change);
  }
  loads_ = target;
  return cavity_volume();
}

Outcome<double> Engine::set_model(const StaticModel& model) {
  equations_.set_model(held(model));
  newton_.forget_tangent();
  if (loads_.pressure == 0.0 && loads_.activation == 0.0) {
    relax();
    return cavity_volume();
  }
  if (newton_.solve(state_, loads_).converged)
    return cavity_volume();
  // passive muscle goes from rest instead: a long way to another stiffness is no sign of buckling
  if (loads_.activation > 0.0 && (hold_firmly() || contracting_gives_way(state_, loads_)))
    return cavity_volume();
  const Loads loads = loads_;
  relax();
  return go_to(loads);
}

Outcome<std::vector<std::vector<Vec3>>> Engine::responses(const std::vector<StaticModel>& others) {
  SparseMatrix K(equations_.pattern(), parameters_.newton.linear, equations_.undeformed());
  equations_.tangent(state_, loads_, K);
  const StaticModel model = equations_.model();
  const std::vector<double> R = equations_.residual(state_, loads_);
  std::vector<std::vector<Vec3>> all;
  std::optional<Unsolved> why;
  for (const StaticModel& other : others) {
    equations_.set_model(held(other));
    std::vector<double> change = equations_.residual(state_, loads_);
    for (std::size_t k = 0; k < change.size(); ++k)
      change[k] = R[k] - change[k];
    const auto u = K.solve(change);
    if (!u) {
      why = u.why();
      break;
    }
    std::vector<Vec3>& moves = all.emplace_back();
    for (std::size_t a = 0; a < state_.positions.size(); ++a)
      moves.emplace_back(u->data() + 3 * a);
  }
  equations_.set_model(model);
  if (why)
    return *why;
  return all;
}

NewtonReport Engine::find(State guess, const Equilibrium& equilibrium) {
  NewtonReport report = newton_.solve(guess, equilibrium);
  if (report.converged) {
    state_ = std::move(guess);
    loads_ = {equilibrium.volume ? state_.cavity_pressure : equilibrium.pressure};
  }
  return report;
}

bool Engine::give_way(const Equilibrium& equilibrium) {
  if (!implicit::give_way(equations_, newton_, state_, equilibrium))
    return false;
  loads_ = {equilibrium.volume ? state_.cavity_pressure : equilibrium.pressure};
  return true;
}

StaticModel Engine::held(StaticModel model) const {
  double& stiffness = model.stabilisation.beta_s;
  if (is_firm_ && stiffness > 0.0)
    stiffness = std::max(stiffness, StaticModel::firm_stabilisation.beta_s);
  return model;
}

bool Engine::hold_firmly() {
  const double before = equations_.model().stabilisation.beta_s;
  if (is_firm_ || before == 0.0 || before >= StaticModel::firm_stabilisation.beta_s)
    return false;
  is_firm_ = true;
  equations_.set_model(held(equations_.model()));
  newton_.forget_tangent();
  State next = state_;
  if (!newton_.solve(next, loads_).converged)
    return false;
  state_ = std::move(next);
  log::info("elements are held against buckling inside by {:.0f} kPa instead of {:.3g} kPa",
            StaticModel::firm_stabilisation.beta_s, before);
  return true;
}

/// A passive wall without an equilibrium near by has none.
bool Engine::contracting_gives_way(State& state, const Loads& loads) {
  return loads.activation > 0.0 &&
         implicit::give_way(equations_, newton_, state,
                            {equations_.steady(loads.activation), loads.pressure});
}

Outcome<double> Engine::get_over(const Obstacle& at, State& state) {
  const double step = std::min(leap, 1.0 - at.progress);
  if (at.may_give_way && contracting_gives_way(state, at.way.at(at.progress + step)))
    return step;
  if (at.way.to.activation == 0.0)
    return no_farther(loads_, at.why);
  log::info("no equilibrium is near: the path of equilibria is followed by its length");
  const Path path =
      follow_path(equations_, state, at.progress, at.way, {.linear = parameters_.newton.linear});
  newton_.forget_tangent();
  const std::string text = "followed by its length, the path of equilibria " + words(path, at.way);
  if (!path.arrived)
    return no_farther(loads_, at.why + "; " + text);
  log::info("{}", text);
  return 1.0 - at.progress;
}

void Engine::relax() {
  restore(equations_.rest(), {});
}

void Engine::restore(const State& state, const Loads& loads) {
  if (state.positions.size() != state_.positions.size() ||
      state.pressures.size() != state_.pressures.size())
    throw InputError("an equilibrium that was kept", "is one of another wall",
                     "Delete the unfinished folder of this stage to start it again");
  state_ = state;
  loads_ = loads;
  newton_.forget_tangent();
}

}  // namespace lv::implicit
