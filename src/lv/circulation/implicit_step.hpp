#pragma once

#include "lv/base/check.hpp"
#include "lv/base/dual.hpp"

#include <Eigen/LU>

#include <array>

namespace lv::circulation {

/// The last two values of N states, for backward differences.
template <int N>
struct History {
  std::array<double, N> now{};
  std::array<double, N> before{};
  double step = 0.0;  ///< between them; 0: there is none before [s]

  /// After a step of dt to `next`.
  void push(const std::array<double, N>& next, double dt) {
    before = now;
    now = next;
    step = dt;
  }
};

/// y^{n+1} = known + weight y'^{n+1}.
template <int N>
struct BackwardDifference {
  std::array<double, N> known;
  double weight;  ///< [s]
};

/// Backward differences of second order for unequal steps, of first order without a value before.
template <int N>
BackwardDifference<N> backward_difference(const History<N>& history, double dt) {
  if (history.step == 0.0)
    return {history.now, dt};
  const double w = dt / history.step;
  const double d = 1.0 + 2.0 * w;
  BackwardDifference<N> result{{}, dt * (1.0 + w) / d};
  for (int i = 0; i < N; ++i)
    result.known[i] = ((1.0 + w) * (1.0 + w) * history.now[i] - w * w * history.before[i]) / d;
  return result;
}

/// The solution of an implicit step and how it follows a parameter.
template <int N>
struct ImplicitStep {
  std::array<double, N> y;
  Eigen::Matrix<double, N, 1> dy_dp;
};

/// Solves y = known + weight f(y, p) by Newton's method, from a guess. `f` takes N numbers and p as
/// Dual<N + 1>. Throws NoSolution when it does not converge.
template <int N, class Rates>
ImplicitStep<N> implicit_step(const Rates& f, const BackwardDifference<N>& difference, double p,
                              const std::array<double, N>& guess) {
  using D = Dual<N + 1>;
  constexpr int most = 100;           // corrections; valves need some ten
  constexpr double rounding = 1e-12;  // of each state
  ImplicitStep<N> s{guess, {}};
  for (int i = 0; i < most; ++i) {
    std::array<D, N> y;
    for (int k = 0; k < N; ++k)
      y[k] = D::variable(s.y[k], k);
    const std::array<D, N> rate = f(y, D::variable(p, N));
    Eigen::Matrix<double, N, N> J;
    Eigen::Matrix<double, N, 2> right;
    for (int k = 0; k < N; ++k) {
      const D residual = y[k] - difference.known[k] - difference.weight * rate[k];
      J.row(k) = residual.slope.template head<N>().transpose();
      right.row(k) << -residual.value, -residual.slope[N];
    }
    const Eigen::Matrix<double, N, 2> solution = J.partialPivLu().solve(right);
    bool done = true;
    for (int k = 0; k < N; ++k) {
      s.y[k] += solution(k, 0);
      done = done && std::abs(solution(k, 0)) <= rounding * (1.0 + std::abs(s.y[k]));
    }
    s.dy_dp = solution.col(1);
    if (done)
      return s;
  }
  throw NoSolution("A step of the circulation has no solution that Newton's method finds",
                   "Lower circulation.step, or widen circulation.valves.smoothing");
}

}  // namespace lv::circulation
