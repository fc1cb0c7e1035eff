#include "lv/quasi_static/newton.hpp"

#include "lv/base/interrupt.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lv::quasi_static {
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
  return to;
}

}  // namespace

/// One search for an equilibrium.
class Newton::Attempt {
 public:
  Attempt(Newton& newton, const State& start, const Loads& loads)
      : newton_(newton),
        loads_(loads),
        state_(start),
        residual_(newton.equations_.residual(start, loads)) {
    if (residual_.empty())
      throw NoConvergence("an element is turned inside out at the start");
  }

  void run() {
    if (newton_.has_tangent_)
      correct();
    else
      renew_tangent();
    while (correction_size_ > newton_.parameters_.tolerance)
      iterate();
    state_ = moved(state_, correction_, 1.0);
  }

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const NewtonReport& report() const { return report_; }

 private:
  std::vector<double> solve_linear(const std::vector<double>& b) {
    std::vector<double> x = newton_.tangent_.solve(b);
    ++report_.linear_solves;
    report_.linear_iterations += newton_.tangent_.iterations();
    return x;
  }

  /// The correction that the tangent at hand asks for.
  void correct() {
    set_correction(solve_linear(residual_));
    fresh_ = false;
  }

  void set_correction(std::vector<double> against) {
    for (double& c : against)
      c = -c;
    correction_ = std::move(against);
    correction_size_ = size(correction_, state_.positions.size());
  }

  void renew_tangent() {
    newton_.equations_.tangent(state_, loads_, newton_.tangent_);
    newton_.has_tangent_ = true;
    ++report_.factorisations;
    correct();
    fresh_ = true;
  }

  void iterate() {
    interrupt::check_together();
    if (++report_.iterations > newton_.parameters_.iterations)
      throw NoConvergence(fmt::format(
          "no equilibrium after {} corrections (the last moved the wall by {:.2g} mm rms)",
          newton_.parameters_.iterations, correction_size_));
    const State trial = moved(state_, correction_, damping_);
    std::vector<double> residual = newton_.equations_.residual(trial, loads_);
    if (residual.empty()) {
      reject("elements turn inside out");
      return;
    }
    const std::vector<double> next = solve_linear(residual);
    const double contraction = size(next, state_.positions.size()) / correction_size_;
    if (!(contraction <= 1.0 - 0.25 * damping_)) {
      reject(fmt::format("corrections do not become smaller (ratio {:.2g})", contraction));
      return;
    }
    state_ = trial;
    residual_ = std::move(residual);
    if (damping_ == 1.0 && contraction < good_contraction) {
      set_correction(next);
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
      throw NoConvergence(why);
  }

  Newton& newton_;
  Loads loads_;
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

NewtonReport Newton::solve(State& state, const Loads& loads) {
  try {
    Attempt attempt(*this, state, loads);
    attempt.run();
    state = attempt.state();
    return attempt.report();
  } catch (const NoConvergence&) {
    has_tangent_ = false;  // it may belong to a place far off
    throw;
  }
}

}  // namespace lv::quasi_static
