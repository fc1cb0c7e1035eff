#pragma once

#include "lv/base/interrupt.hpp"
#include "lv/implicit/sparse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lv::implicit {

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

/// K^-1 b, counted in the report; nothing where there is none, with the reason in the report.
/// Collective.
[[nodiscard]] std::optional<std::vector<double>> solve(SparseMatrix& K,
                                                       const std::vector<double>& b,
                                                       NewtonReport& report);

/// The rms of a correction's first 3 `nodes` components, those of positions [mm].
[[nodiscard]] double rms_displacement(const std::vector<double>& correction, std::size_t nodes);

/// Adds so much of a correction to positions and then to pressures. What follows in it.
std::span<const double> add(std::span<const double> correction, double by,
                            std::vector<Vec3>& positions, std::vector<double>& pressures);

/// Damped Newton with the error-oriented monotonicity test (P. Deuflhard, Newton Methods for
/// Nonlinear Problems, 2004, algorithm NLEQ-ERR): a step is taken as far as it makes the next
/// simplified correction, by the same tangent, smaller. A tangent that contracts well enough is
/// kept from step to step, since a factorisation costs far more than a correction.
///
/// A problem has a `Place`, the values of its unknowns, those of positions first, and
///
///   residual(place)              R; empty where elements are turned inside out
///   has_tangent()                K of any place
///   renew_tangent(place, report) K of this place; false, with the reason, where it cannot be used
///   solve(R, place, report)      K^-1 R of this place's residual; nothing, with the reason
///   moved(place, correction, by) the place with so much of a correction added
///   node_count()
///
/// All are collective.
template <class Problem>
class DampedNewton {
 public:
  using Place = typename Problem::Place;

  /// Problem and parameters must outlive this object.
  DampedNewton(Problem& problem, const NewtonParameters& parameters, Place start)
      : problem_(problem),
        parameters_(parameters),
        place_(std::move(start)),
        residual_(problem.residual(place_)) {}

  /// Until a correction is within the tolerance [mm]; `place()` is where that leads.
  NewtonReport run(double tolerance) {
    if (residual_.empty())
      give_up("an element is turned inside out at the start");
    else if (problem_.has_tangent())
      correct();
    else
      renew_tangent();
    while (!gave_up() && correction_size_ > tolerance)
      iterate();
    report_.converged = !gave_up();
    if (report_.converged)
      place_ = problem_.moved(std::move(place_), correction_, 1.0);
    return report_;
  }

  [[nodiscard]] Place&& place() { return std::move(place_); }

 private:
  /// Below this ratio of successive corrections a tangent is kept.
  static constexpr double good_contraction = 0.3;

  void give_up(const std::string& why) { report_.why = why; }
  [[nodiscard]] bool gave_up() const { return !report_.why.empty(); }

  /// The correction that the tangent at hand asks for.
  void correct() {
    if (auto against = problem_.solve(residual_, place_, report_))
      set_correction(std::move(*against));
    fresh_ = false;
  }

  void set_correction(std::vector<double> against) {
    for (double& c : against)
      c = -c;
    correction_ = std::move(against);
    correction_size_ = size_of(correction_);
  }

  [[nodiscard]] double size_of(const std::vector<double>& correction) const {
    return rms_displacement(correction, problem_.node_count());
  }

  void renew_tangent() {
    ++report_.factorisations;
    if (!problem_.renew_tangent(place_, report_))
      return;
    correct();
    fresh_ = true;
  }

  void iterate() {
    interrupt::check_together();
    if (++report_.iterations > parameters_.iterations) {
      give_up(fmt::format(
          "no equilibrium after {} corrections (the last moved the wall by {:.2g} mm rms)",
          parameters_.iterations, correction_size_));
      return;
    }
    Place trial = problem_.moved(place_, correction_, damping_);
    std::vector<double> residual = problem_.residual(trial);
    if (residual.empty()) {
      reject("elements turn inside out");
      return;
    }
    auto next = problem_.solve(residual, trial, report_);
    if (!next)
      return;
    const double contraction = size_of(*next) / correction_size_;
    if (!(contraction <= 1.0 - 0.25 * damping_)) {
      reject(fmt::format("corrections do not become smaller (ratio {:.2g})", contraction));
      return;
    }
    place_ = std::move(trial);
    residual_ = std::move(residual);
    if (damping_ == 1.0 && contraction < good_contraction) {
      set_correction(std::move(*next));
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
    if (damping_ < parameters_.smallest_damping)
      give_up(why);
  }

  Problem& problem_;
  const NewtonParameters& parameters_;
  Place place_;
  std::vector<double> residual_, correction_;
  double correction_size_ = 0.0;  ///< [mm]
  double damping_ = 1.0;
  bool fresh_ = false;  ///< the tangent is that of place_
  NewtonReport report_;
};

}  // namespace lv::implicit
