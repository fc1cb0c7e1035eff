#include "lv/implicit/inverse.hpp"

#include "lv/base/interrupt.hpp"
#include "lv/base/log.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/implicit/unload_forecast.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace lv::implicit {
namespace {

constexpr double ratio_to_keep = 0.3;  // ratio of successive corrections

constexpr double first_share = 1.0 / 32;  // of the pressure
constexpr double usual_factor = 2.0;      // from one pressure to the next
constexpr double smallest_factor = 1.1;   // before it gives up
constexpr double least_share = 1e-4;
constexpr double on_the_way = 0.05;  // tolerance before the whole pressure [mm]

constexpr int most_holds = 4;  // of directions near the axis

double rms_of(const std::vector<double>& correction, std::size_t nodes) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 3 * nodes; ++k)
    sum += correction[k] * correction[k];
  return std::sqrt(sum / static_cast<double>(nodes));
}

double largest_between(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

Reference moved(Reference z, const std::vector<double>& correction, double by) {
  const double* next = correction.data();
  for (Vec3& X : z.nodes)
    for (int i = 0; i < 3; ++i)
      X[i] += by * *next++;
  for (double& p : z.pressures)
    p += by * *next++;
  return z;
}

/// The straight line through two walls, `by` times their distance beyond the second.
Reference extended(const Reference& before, Reference now, double by) {
  for (std::size_t a = 0; a < now.nodes.size(); ++a)
    now.nodes[a] += by * (now.nodes[a] - before.nodes[a]);
  for (std::size_t m = 0; m < now.pressures.size(); ++m)
    now.pressures[m] += by * (now.pressures[m] - before.pressures[m]);
  return now;
}

}  // namespace

/// One search under one pressure.
class InverseNewton::Attempt {
 public:
  Attempt(InverseNewton& newton, Reference start, double pressure)
      : newton_(newton),
        pressure_(pressure),
        z_(std::move(start)),
        R_(newton.equations_.residual(z_, pressure)) {}

  NewtonReport run(double tolerance) {
    if (R_.empty())
      give_up("an element is turned inside out at the start");
    else if (newton_.has_tangent_)
      set_correction(solve(R_));
    else
      renew_tangent();
    while (!gave_up() && size_ > tolerance)
      iterate();
    report_.converged = !gave_up();
    if (report_.converged)
      z_ = moved(std::move(z_), correction_, 1.0);
    return report_;
  }

  [[nodiscard]] Reference&& found() { return std::move(z_); }

 private:
  void give_up(const char* why) { report_.why = why; }
  [[nodiscard]] bool gave_up() const { return !report_.why.empty(); }

  /// -K^-1 R; empty where there is none, which ends the attempt.
  std::vector<double> solve(const std::vector<double>& R) {
    const auto against = newton_.tangent_.solve(R);
    ++report_.linear_solves;
    if (!against) {
      give_up("the linear equations are singular");
      return {};
    }
    std::vector<double> correction = *against;
    for (double& c : correction)
      c = -c;
    return correction;
  }

  void set_correction(std::vector<double> correction) {
    if (gave_up())
      return;
    correction_ = std::move(correction);
    size_ = rms_of(correction_, z_.nodes.size());
    fresh_ = false;
  }

  void renew_tangent() {
    newton_.equations_.tangent(z_, newton_.tangent_);
    newton_.has_tangent_ = true;
    ++report_.factorisations;
    set_correction(solve(R_));
    fresh_ = true;
  }

  void iterate() {
    interrupt::check_together();
    if (++report_.iterations > newton_.parameters_.iterations) {
      give_up("too many corrections");
      return;
    }
    Reference trial = moved(z_, correction_, damping_);
    std::vector<double> R = newton_.equations_.residual(trial, pressure_);
    if (R.empty()) {
      reject("elements turn inside out");
      return;
    }
    std::vector<double> next = solve(R);
    if (gave_up())
      return;
    const double ratio = rms_of(next, z_.nodes.size()) / size_;
    if (!(ratio <= 1.0 - 0.25 * damping_)) {
      reject("corrections do not become smaller");
      return;
    }
    z_ = std::move(trial);
    R_ = std::move(R);
    if (damping_ == 1.0 && ratio < ratio_to_keep) {
      set_correction(std::move(next));
      return;
    }
    damping_ = std::min(1.0, 2.0 * damping_);
    renew_tangent();
  }

  /// A step that failed is tried again with the right tangent, then shorter.
  void reject(const char* why) {
    if (!fresh_) {
      renew_tangent();
      return;
    }
    damping_ *= 0.5;
    if (damping_ < newton_.parameters_.smallest_damping)
      give_up(why);
  }

  InverseNewton& newton_;
  double pressure_;
  Reference z_;
  std::vector<double> R_, correction_;
  double size_ = 0.0;  ///< rms of the correction [mm]
  double damping_ = 1.0;
  bool fresh_ = false;  ///< the tangent is that of z_
  NewtonReport report_;
};

InverseNewton::InverseNewton(const InverseEquations& equations, const NewtonParameters& parameters)
    : equations_(equations),
      parameters_(parameters),
      tangent_(equations.pattern(), {}, equations.seen().nodes) {}

NewtonReport InverseNewton::solve(Reference& reference, double pressure, double tolerance) {
  Attempt attempt(*this, reference, pressure);
  NewtonReport report = attempt.run(tolerance);
  if (report.converged)
    reference = attempt.found();
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

 private:
  bool starts_from(Reference guess) {
    guess.pressures.resize(now_.pressures.size(), 0.0);
    now_ = std::move(guess);
    return solves(now_, pressure_);
  }

  /// Whether the whole pressure is reached.
  bool follows_pressure() {
    std::optional<Reference> before;
    double reached = 0.0, last_factor = 1.0;
    double next = first_share * pressure_;
    double factor = usual_factor;
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
      if (const double by = largest_between(last.nodes, now_.nodes); by < least) {
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
};

}  // namespace

std::optional<Reference> find_reference(const mesh::Mesh& seen, const StaticModel& model,
                                        double pressure, const NewtonParameters& parameters,
                                        const Reference* guess, double afterwards) {
  return ReferenceSearch(seen, model, pressure, parameters, afterwards).run(guess);
}

}  // namespace lv::implicit
