#include "lv/implicit/inverse.hpp"

#include "lv/base/log.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/implicit/unload_forecast.hpp"
#include "lv/mesh/distance.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace lv::implicit {
namespace {

constexpr double first_share = 1.0 / 32;  // of the pressure
constexpr double usual_factor = 2.0;      // from one pressure to the next
constexpr double smallest_factor = 1.1;   // before it gives up
constexpr double least_share = 1e-4;
constexpr int most_failures = 8;     // of steps along the pressure; usual hearts have two at most
constexpr double on_the_way = 0.05;  // tolerance before the whole pressure [mm]

constexpr int most_holds = 4;  // of directions near the axis

/// The straight line through two walls, `by` times their distance beyond the second.
Reference extended(const Reference& before, Reference now, double by) {
  for (std::size_t a = 0; a < now.nodes.size(); ++a)
    now.nodes[a] += by * (now.nodes[a] - before.nodes[a]);
  for (std::size_t m = 0; m < now.pressures.size(); ++m)
    now.pressures[m] += by * (now.pressures[m] - before.pressures[m]);
  return now;
}

}  // namespace

/// The wall under one pressure, for DampedNewton.
class InverseNewton::Problem {
 public:
  using Place = Reference;

  Problem(InverseNewton& newton, double pressure) : newton_(newton), pressure_(pressure) {}

  [[nodiscard]] std::vector<double> residual(const Reference& z) const {
    return newton_.equations_.residual(z, pressure_);
  }

  [[nodiscard]] bool has_tangent() const { return newton_.has_tangent_; }

  bool renew_tangent(const Reference& z, NewtonReport& /*report*/) {
    newton_.equations_.tangent(z, newton_.tangent_);
    newton_.has_tangent_ = true;
    return true;
  }

  std::optional<std::vector<double>> solve(const std::vector<double>& R, const Reference& /*of*/,
                                           NewtonReport& report) {
    return implicit::solve(newton_.tangent_, R, report);
  }

  [[nodiscard]] static Reference moved(Reference z, const std::vector<double>& correction,
                                       double by) {
    add(correction, by, z.nodes, z.pressures);
    return z;
  }

  [[nodiscard]] std::size_t node_count() const {
    return static_cast<std::size_t>(newton_.equations_.node_count());
  }

 private:
  InverseNewton& newton_;
  double pressure_;
};

InverseNewton::InverseNewton(const InverseEquations& equations, const NewtonParameters& parameters)
    : equations_(equations),
      parameters_(parameters),
      tangent_(equations.pattern(), {}, equations.seen().nodes) {}

NewtonReport InverseNewton::solve(Reference& reference, double pressure, double tolerance) {
  Problem problem(*this, pressure);
  DampedNewton<Problem> search(problem, parameters_, reference);
  NewtonReport report = search.run(tolerance);
  if (report.converged)
    reference = search.place();
  else
    has_tangent_ = false;  // it may belong to a place far off
  return report;
}

namespace {

class ReferenceSearch {
 public:
  ReferenceSearch(const mesh::Mesh& seen, const StaticModel& model, double pressure,
                  const NewtonParameters& parameters, double afterwards)
      : equations_(seen, model),
        newton_(equations_, parameters),
        endocardium_(seen),
        pressure_(pressure),
        tolerance_(parameters.tolerance),
        afterwards_(afterwards),
        now_(equations_.seen()) {}

  std::optional<Reference> run(const Reference* guess) {
    if (guess != nullptr && starts_from(*guess))
      return settled();
    now_ = equations_.seen();
    if (!follows_pressure())
      return {};
    return settled();
  }

  std::optional<double> share_that_leaves(double volume) {
    sought_volume_ = volume;
    follows_pressure();
    return share_;
  }

 private:
  bool starts_from(Reference guess) {
    guess.pressures.resize(now_.pressures.size(), 0.0);
    now_ = std::move(guess);
    return solves(now_, pressure_);
  }

  /// Whether the whole pressure is reached, or the volume that is sought.
  bool follows_pressure() {
    std::optional<Reference> before;
    double reached = 0.0, last_factor = 1.0;
    double next = first_share * pressure_;
    double factor = usual_factor;
    int failures = 0;
    while (reached < pressure_) {
      next = next > 0.99 * pressure_ ? pressure_ : next;
      Reference z =
          before ? extended(*before, now_, std::log(next / reached) / std::log(last_factor)) : now_;
      if (solves(z, next)) {
        last_factor = next / reached;
        if (reached > 0.0)
          before = std::move(now_);
        now_ = std::move(z);
        reached = next;
        factor = std::min(usual_factor, std::pow(factor, 1.5));
        say(reached, factor);
        if (passes(reached))
          return true;
      } else if (++failures >= most_failures) {
        return false;  // a path that creeps
      } else if (before) {
        before.reset();  // once more without extrapolation
        continue;
      } else {
        factor = reached > 0.0 ? std::sqrt(factor) : factor;
        next *= 0.25;
      }
      if (reached > 0.0)
        next = factor * reached;
      if (factor < smallest_factor || next < least_share * pressure_)
        return false;
    }
    return true;
  }

  /// Whether the wall under this pressure, the next of the path, holds no more than is sought.
  bool passes(double pressure) {
    const double volume = endocardium_.volume(now_.nodes);
    const double ln_share = std::log(pressure / pressure_);
    if (volume <= sought_volume_) {
      const auto [last_volume, last_ln_share] = last_passed_.value_or(std::pair(volume, ln_share));
      const double back =
          volume < last_volume ? (sought_volume_ - volume) / (last_volume - volume) : 0.0;
      share_ = std::exp(ln_share + back * (last_ln_share - ln_share));
      return true;
    }
    last_passed_ = {volume, ln_share};
    return false;
  }

  bool solves(Reference& z, double pressure) {
    equations_.hold_frames(z);
    newton_.forget_tangent();
    const auto began = std::chrono::steady_clock::now();
    const auto report = newton_.solve(z, pressure, pressure < pressure_ ? on_the_way : tolerance_);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began;
    forecast_.spent(elapsed.count(), report.factorisations);
    if (!report.converged)
      log::info("no wall without load was found at {:.3g} mmHg: {}", pressure / units::mmHg,
                report.why);
    return report.converged;
  }

  void say(double reached, double factor) const {
    const double steps = std::ceil(std::log(pressure_ / reached) / std::log(factor) - 0.01);
    log::info("unloading from {:.3g} mmHg: {:.2f} of {:.2f} ml are left{} of unloading",
              reached / units::mmHg, 1e-3 * endocardium_.volume(now_.nodes),
              1e-3 * endocardium_.volume(equations_.seen().nodes),
              time_left(forecast_.seconds_left(steps) + afterwards_));
  }

  Reference settled() {
    if (!equations_.holds_frames())
      return std::move(now_);
    Reference best = now_;
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n < most_holds && least > tolerance_; ++n) {
      const Reference last = now_;
      equations_.hold_frames(now_);
      if (!newton_.solve(now_, pressure_, tolerance_).converged)
        break;
      if (const double by = mesh::largest_distance(last.nodes, now_.nodes); by < least) {
        least = by;
        best = last;
      }
    }
    return best;
  }

  InverseEquations equations_;
  InverseNewton newton_;
  solid::EndocardialSurface endocardium_;
  double pressure_, tolerance_, afterwards_;
  PathForecast forecast_;
  Reference now_;
  double sought_volume_ = 0.0;  ///< where the path ends before the whole pressure [mm^3]
  std::optional<std::pair<double, double>> last_passed_;  ///< volume and ln(share) on the path
  std::optional<double> share_;                           ///< where that volume is left
};

}  // namespace

std::optional<Reference> find_reference(const mesh::Mesh& seen, const StaticModel& model,
                                        double pressure, const NewtonParameters& parameters,
                                        const Reference* guess, double afterwards) {
  return ReferenceSearch(seen, model, pressure, parameters, afterwards).run(guess);
}

std::optional<double> share_that_leaves(double volume, const mesh::Mesh& seen,
                                        const StaticModel& model, double pressure,
                                        const NewtonParameters& parameters) {
  return ReferenceSearch(seen, model, pressure, parameters, 0.0).share_that_leaves(volume);
}

}  // namespace lv::implicit
