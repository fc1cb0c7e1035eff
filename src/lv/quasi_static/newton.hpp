#pragma once

#include "lv/quasi_static/equations.hpp"

#include <string>

namespace lv::quasi_static {

struct NewtonParameters {
  double tolerance = 1e-6;         ///< rms of the last correction of the positions [mm]
  int iterations = 40;             ///< corrections after which it gives up
  double smallest_damping = 0.01;  ///< of a correction, before it gives up
  LinearParameters linear = {};
};

/// How one equilibrium was found, or why it was not.
struct [[nodiscard]] NewtonReport {
  bool converged = false;
  std::string why;  ///< it did not
  int iterations = 0;
  int factorisations = 0;
  int linear_solves = 0;
  int linear_iterations = 0;  ///< of all linear solves; 0 of the direct method
};

/// Damped Newton with the error-oriented monotonicity test (P. Deuflhard, Newton Methods for
/// Nonlinear Problems, 2004, algorithm NLEQ-ERR): a step is taken as far as it makes the next
/// simplified correction, by the same tangent, smaller. A tangent that contracts well enough is
/// kept from step to step, since a factorisation costs far more than a correction.
class Newton {
 public:
  /// The equations must outlive this object.
  Newton(const Equations& equations, const NewtonParameters& parameters);

  /// Brings `state` to equilibrium under `loads`, or leaves it as it was. Collective.
  NewtonReport solve(State& state, const Loads& loads);

  /// The muscle has changed: the tangent is of no use any more.
  void forget_tangent() { has_tangent_ = false; }

 private:
  class Attempt;

  const Equations& equations_;
  NewtonParameters parameters_;
  SparseMatrix tangent_;
  bool has_tangent_ = false;
};

}  // namespace lv::quasi_static
