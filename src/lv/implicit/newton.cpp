#include "lv/implicit/newton.hpp"

#include <numeric>
#include <optional>

namespace lv::implicit {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

/// One equilibrium, for DampedNewton.
class Newton::Problem {
 public:
  using Place = State;

  Problem(Newton& newton, const Equilibrium& equilibrium)
      : newton_(newton), equilibrium_(equilibrium) {}

  /// With r_V at its end where a volume is given.
  [[nodiscard]] std::vector<double> residual(const State& state) const {
    std::vector<double> R = newton_.equations_.residual(
        state, pressure_of(state), equilibrium_.tension, equilibrium_.motion, equilibrium_.base);
    if (has_volume() && !R.empty())
      R.push_back(newton_.equations_.endocardium().volume(state.positions) -
                  equilibrium_.volume(state.cavity_pressure).volume);
    return R;
  }

  [[nodiscard]] bool has_tangent() const { return newton_.has_tangent_; }

  bool renew_tangent(const State& state, NewtonReport& report) {
    newton_.equations_.tangent(state, pressure_of(state), equilibrium_.tension, newton_.tangent_,
                               equilibrium_.motion);
    newton_.has_tangent_ = true;
    return !has_volume() || renew_response(state, report);
  }

  /// The solution of the whole system.
  std::optional<std::vector<double>> solve(const std::vector<double>& R, const State& state,
                                           NewtonReport& report) {
    if (!has_volume())
      return implicit::solve(newton_.tangent_, R, report);
    auto u = implicit::solve(newton_.tangent_, {R.begin(), R.end() - 1}, report);
    if (!u)
      return {};
    const double c = equilibrium_.volume(state.cavity_pressure).per_pressure;
    const double p =
        (dot(newton_.gradient_, *u) - R.back()) / (c - dot(newton_.gradient_, newton_.response_));
    for (std::size_t k = 0; k < u->size(); ++k)
      (*u)[k] += p * newton_.response_[k];
    u->push_back(p);
    return u;
  }

  [[nodiscard]] static State moved(State state, const std::vector<double>& correction, double by) {
    const auto rest = add(correction, by, state.positions, state.pressures);
    if (!rest.empty())
      state.cavity_pressure += by * rest.front();
    return state;
  }

  [[nodiscard]] std::size_t node_count() const { return newton_.equations_.undeformed().size(); }

 private:
  [[nodiscard]] bool has_volume() const { return static_cast<bool>(equilibrium_.volume); }
  [[nodiscard]] double pressure_of(const State& state) const {
    return has_volume() ? state.cavity_pressure : equilibrium_.pressure;
  }

  bool renew_response(const State& state, NewtonReport& report) {
    newton_.gradient_ = newton_.equations_.volume_gradient(state);
    auto response =
        implicit::solve(newton_.tangent_, newton_.equations_.pressure_force(state), report);
    if (response)
      newton_.response_ = std::move(*response);
    return response.has_value();
  }

  Newton& newton_;
  const Equilibrium& equilibrium_;
};

Newton::Newton(const Equations& equations, const NewtonParameters& parameters)
    : equations_(equations),
      parameters_(parameters),
      tangent_(equations.pattern(), parameters.linear, equations.undeformed()) {}

NewtonReport Newton::solve(State& state, const Equilibrium& equilibrium) {
  Problem problem(*this, equilibrium);
  DampedNewton<Problem> search(problem, parameters_, state);
  NewtonReport report = search.run(parameters_.tolerance);
  if (report.converged)
    state = search.place();
  else
    has_tangent_ = false;  // it may belong to a place far off
  return report;
}

}  // namespace lv::implicit
