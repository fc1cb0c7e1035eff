#include "lv/implicit/newton.hpp"

#include "lv/base/interrupt.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <optional>

namespace lv::implicit {
namespace {

/// Below this ratio of successive corrections a tangent is kept.
constexpr double good_contraction = 0.3;

/// rms displacement of a correction [mm].
double size(const std::vector<double>& correction, std::size_t nodes) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 3 * nodes; ++k)
    sum += correction[k] * correction[k];
  return std::sqrt(sum / static_cast<double>(nodes));
}

State moved(const State& from, const std::vector<double>& correction, double by) {
  State to = from;
  const double* next = correction.data();
  for (Vec3& x : to.positions)
    for (int i = 0; i < 3; ++i)
      x[i] += by * *next++;
  for (double& p : to.pressures)
    p += by * *next++;
  if (next != correction.data() + correction.size())
    to.cavity_pressure += by * *next;
  return to;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

/// One search for an equilibrium.
class Newton::Attempt {
 public:
  Attempt(Newton& newton, const State& start, const Equilibrium& equilibrium)
      : newton_(newton), equilibrium_(equilibrium), state_(start), residual_(residual_of(start)) {}

  NewtonReport run() {
    if (residual_.empty())
      give_up("an element is turned inside out at the start");
    else if (newton_.has_tangent_)
      correct();
    else
      renew_tangent();
    while (!gave_up() && correction_size_ > newton_.parameters_.tolerance)
      iterate();
    report_.converged = !gave_up();
    if (report_.converged)
      state_ = moved(state_, correction_, 1.0);
    return report_;
  }

  [[nodiscard]] const State& state() const { return state_; }

 private:
  void give_up(const std::string& why) { report_.why = why; }
  [[nodiscard]] bool gave_up() const { return !report_.why.empty(); }

  [[nodiscard]] bool has_volume() const { return static_cast<bool>(equilibrium_.volume); }
  [[nodiscard]] double pressure_of(const State& state) const {
    return has_volume() ? state.cavity_pressure : equilibrium_.pressure;
  }

  /// R, with r_V at its end where a volume is given; empty when elements are turned inside out.
  [[nodiscard]] std::vector<double> residual_of(const State& state) {
    std::vector<double> R = newton_.equations_.residual(
        state, pressure_of(state), equilibrium_.tension, equilibrium_.motion, equilibrium_.base);
    if (has_volume() && !R.empty()) {
      given_ = equilibrium_.volume(state.cavity_pressure);
      R.push_back(newton_.equations_.endocardium().volume(state.positions) - given_.volume);
    }
    return R;
  }

  /// The solution of the whole system for a residual. Nothing when there is none, which ends the
  /// attempt.
  std::optional<std::vector<double>> solve_for(const std::vector<double>& residual) {
    if (!has_volume())
      return solve_linear(residual);
    auto u = solve_linear({residual.begin(), residual.end() - 1});
    if (!u)
      return {};
    const double p = (dot(newton_.gradient_, *u) - residual.back()) /
                     (given_.per_pressure - dot(newton_.gradient_, newton_.response_));
    for (std::size_t k = 0; k < u->size(); ++k)
      (*u)[k] += p * newton_.response_[k];
    u->push_back(p);
    return u;
  }

  /// K x = b.
  std::optional<std::vector<double>> solve_linear(const std::vector<double>& b) {
    const auto x = newton_.tangent_.solve(b);
    ++report_.linear_solves;
    report_.linear_iterations += newton_.tangent_.iterations();
    if (x)
      return *x;
    give_up(x.why().what);
    return {};
  }

  /// The correction that the tangent at hand asks for.
  void correct() {
    if (has_volume())  // after a trial that was rejected it is of that
      given_ = equilibrium_.volume(state_.cavity_pressure);
    if (auto against = solve_for(residual_))
      set_correction(std::move(*against));
    fresh_ = false;
  }

  void set_correction(std::vector<double> against) {
    for (double& c : against)
      c = -c;
    correction_ = std::move(against);
    correction_size_ = size(correction_, state_.positions.size());
  }

  void renew_tangent() {
    newton_.equations_.tangent(state_, pressure_of(state_), equilibrium_.tension, newton_.tangent_,
                               equilibrium_.motion);
    newton_.has_tangent_ = true;
    ++report_.factorisations;
    if (has_volume() && !renew_response())
      return;
    correct();
    fresh_ = true;
  }

  bool renew_response() {
    newton_.gradient_ = newton_.equations_.volume_gradient(state_);
    auto response = solve_linear(newton_.equations_.pressure_force(state_));
    if (response)
      newton_.response_ = std::move(*response);
    return response.has_value();
  }

  void iterate() {
    interrupt::check_together();
    if (++report_.iterations > newton_.parameters_.iterations) {
      give_up(
          fmt::format("no equilibrium after {} corrections (the last moved the wall by {:.2g} mm "
                      "rms)",
                      newton_.parameters_.iterations, correction_size_));
      return;
    }
    const State trial = moved(state_, correction_, damping_);
    std::vector<double> residual = residual_of(trial);
    if (residual.empty()) {
      reject("elements turn inside out");
      return;
    }
    const auto next = solve_for(residual);
    if (!next)
      return;
    const double contraction = size(*next, state_.positions.size()) / correction_size_;
    if (!(contraction <= 1.0 - 0.25 * damping_)) {
      reject(fmt::format("corrections do not become smaller (ratio {:.2g})", contraction));
      return;
    }
    state_ = trial;
    residual_ = std::move(residual);
    if (damping_ == 1.0 && contraction < good_contraction) {
      set_correction(*next);
      fresh_ = false;
      return;
    }
    damping_ = std::min(1.0, 2.0 * damping_);
    renew_tangent();
  }

  /// A step that failed is tried again with the right tangent, then shorter.
  void reject(const std::string& why) {
    if (!fresh_) {
      renew_tangent();
      return;
    }
    damping_ *= 0.5;
    if (damping_ < newton_.parameters_.smallest_damping)
      give_up(why);
  }

  Newton& newton_;
  const Equilibrium& equilibrium_;
  GivenVolume given_;  ///< for the residual computed last
  State state_;
  std::vector<double> residual_, correction_;
  double correction_size_ = 0.0;
  double damping_ = 1.0;
  bool fresh_ = false;  ///< the tangent is that of state_
  NewtonReport report_;
};

Newton::Newton(const Equations& equations, const NewtonParameters& parameters)
    : equations_(equations),
      parameters_(parameters),
      tangent_(equations.pattern(), parameters.linear, equations.undeformed()) {}

NewtonReport Newton::solve(State& state, const Equilibrium& equilibrium) {
  Attempt attempt(*this, state, equilibrium);
  NewtonReport report = attempt.run();
  if (report.converged)
    state = attempt.state();
  else
    has_tangent_ = false;  // it may belong to a place far off
  return report;
}

}  // namespace lv::implicit
