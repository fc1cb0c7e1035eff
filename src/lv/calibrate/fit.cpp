#include "lv/calibrate/fit.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/forecast.hpp"
#include "lv/calibrate/klotz.hpp"
#include "lv/calibrate/least_squares.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>

namespace lv::calibrate {
namespace {

using quasi_static::Loads;

/// Volumes are met this much better than asked; unloading leaves them scattered by less.
constexpr double margin = 5e-3;

constexpr std::array<double, 3> pressure_ratios{0.25, 0.5, 2.0};  // to the end-diastolic one

/// Of the measured point against the Klotz curve, which only tells where on the line of equal
/// end-diastolic volumes the parameters are.
constexpr double weight_of_edv = 1e3;

/// First steps of a bracket.
constexpr double far = 1.5;
constexpr double near = 1.05;

// logarithms of the exponent
constexpr double difference = 1e-2;  // for derivatives
constexpr double longest_step = 0.25;
constexpr double converged = 1e-3;
constexpr int most_corrections = 20;

/// The parts of Fitter::run, with the equilibria that they took on ordinary ventricles.
std::vector<FitPart> parts_of(const Plan& plan) {
  const bool passive = plan.passive != Passive::none;
  const bool curve = plan.passive == Passive::scale_and_exponent;
  std::vector<FitPart> parts;
  const auto fit_passive = [&](double trials) {
    if (passive)
      parts.push_back({"bracket", {trials, 0.0}});
    if (curve)
      parts.push_back({"curve", {5.0 * trials, 0.0}});
  };
  fit_passive(6.0);
  if (plan.active) {
    parts.push_back({"bracket", {0.0, 6.0}});
    fit_passive(3.0);
    parts.push_back({"bracket", {0.0, 3.0}});
  }
  const double fitted = (passive ? 1.0 : 0.0) + (curve ? 1.0 : 0.0) + (plan.active ? 1.0 : 0.0);
  const double at_rest = (passive ? 1.0 : 0.0) + (curve ? 3.0 : 0.0);
  const double at_work = plan.active ? 1.0 : 0.0;
  if (!plan.strains.empty())
    parts.push_back(
        {"least squares",
         {8.0 * (fitted + 1.0) * (at_rest + 1.0), 8.0 * (fitted + 1.0) * (at_work + 1.0)}});
  parts.push_back({"result", {std::max(1.0, at_rest), at_work}});
  parts.push_back(
      {"sensitivity", {2.0 * (fitted + 1.0) * at_rest, 2.0 * (fitted + 1.0) * at_work}});
  return parts;
}

class Fitter {
 public:
  Fitter(const Model& model, const Parameters& start, const Plan& plan)
      : plan_(plan), model_(model), forecast_(parts_of(plan)) {
    fit_.parameters = start;
    if (plan.strains.empty())
      model_.strains = {};
    model_.volume = [this, &model](const Parameters& p, const Loads& loads) {
      const auto began = std::chrono::steady_clock::now();
      const double volume = model.volume(p, loads);
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began;
      forecast_.record(loads.activation > 0.0 ? MuscleState::contracts : MuscleState::rests,
                       elapsed.count());
      fit_.history.push_back({purpose_, p, loads, volume});
      log::info(
          "{:<22} C_a {:.4g}  scale {:.4g}  exponent {:.4g}  T_scale {:.4g}  {:.2f} mmHg  "
          "{:.3f} ml, about {} left",
          purpose_, p.C_a, p.scale, p.exponent, p.T_scale, loads.pressure / units::mmHg,
          1e-3 * volume, log::duration(forecast_.seconds_left()));
      return volume;
    };
  }

  Fit run() {
    observe();
    std::vector<Fitted> fitted;
    if (plan_.passive != Passive::none)
      fitted.push_back(plan_.passive == Passive::C_a ? Fitted{"C_a", &Parameters::C_a}
                                                     : Fitted{"scale", &Parameters::scale});
    if (plan_.passive == Passive::scale_and_exponent)
      fitted.push_back({"exponent", &Parameters::exponent});
    fit_passive(fitted, far);
    if (plan_.active) {
      fitted.push_back({"T_scale", &Parameters::T_scale});
      bracket(fitted.back(), plan_.T_scale, es_loads(), plan_.esv, far);
      // with the tension at rest, the end-diastolic volume has moved a little
      fit_passive(fitted, near);
      bracket(fitted.back(), plan_.T_scale, es_loads(), plan_.esv, near);
    }
    if (model_.strains)
      fit_strains(fitted);
    measure();
    begin("sensitivity");
    fit_.sensitivity = sensitivity(model_, fit_.parameters, fitted, fit_.observations,
                                   plan_.edv.volume, ed_loads(), es_loads(), plan_.errors);
    return std::move(fit_);
  }

 private:
  [[nodiscard]] Loads ed_loads() const { return {plan_.ed_pressure, 0.0}; }
  [[nodiscard]] Loads es_loads() const { return {plan_.es_pressure, 1.0}; }

  void begin(const std::string& purpose) {
    purpose_ = purpose;
    forecast_.begin();
  }

  /// Of `fitted`, the passive parameters.
  void fit_passive(const std::vector<Fitted>& fitted, double first_factor) {
    if (plan_.passive == Passive::none)
      return;
    bracket(fitted.front(), plan_.stiffness, ed_loads(), plan_.edv, first_factor);
    if (plan_.passive == Passive::scale_and_exponent)
      fit_exponent(fitted[0], fitted[1]);
  }

  void bracket(const Fitted& which, const Range& range, const Loads& loads, const Target& target,
               double first_factor) {
    begin(fmt::format("bracket of {}", which.name));
    solve(which, range, loads, target, first_factor);
  }

  /// Brings the scale back to the measured end-diastolic volume after a small change.
  void keep_edv(const Fitted& scale) { solve(scale, plan_.stiffness, ed_loads(), plan_.edv, near); }

  void solve(const Fitted& which, const Range& range, const Loads& loads, const Target& target,
             double first_factor) {
    Parameters& p = fit_.parameters;
    const auto volume = [&](double x) {
      p.*which.member = x;
      return model_.volume(p, loads);
    };
    p.*which.member = find_root(volume, {which.name, p.*which.member, range, first_factor}, target,
                                margin * plan_.tolerance);
  }

  /// The measured points, and the Klotz curve where it is fitted to.
  void observe() {
    const double edv = plan_.edv.volume;
    const bool curve = plan_.passive == Passive::scale_and_exponent;
    auto& list = fit_.observations;
    if (plan_.passive != Passive::none)
      list.push_back(
          {"EDV", ed_loads(), edv, curve && !model_.strains ? weight_of_edv : 1.0, 1.0, 1.0});
    if (curve)
      for (const double ratio : pressure_ratios) {
        const double filling = klotz_filling(ratio);
        list.push_back({fmt::format("Klotz, {:g} p_ED", ratio),
                        {ratio * plan_.ed_pressure, 0.0},
                        0.0,  // see move_curve
                        1.0,
                        ratio,
                        filling,
                        1.0 - filling});
      }
    if (plan_.active)
      list.push_back({"ESV", es_loads(), plan_.esv.volume});
  }

  /// The Klotz curve starts from the model's volume without load.
  void move_curve(const Parameters& p) {
    for (Observation& o : fit_.observations)
      if (o.target_by_unloaded != 0.0)
        o.target =
            o.target_by_unloaded * model_.unloaded_volume(p) + o.target_by_edv * plan_.edv.volume;
  }

  /// Levenberg-Marquardt in the logarithms of the parameters.
  void fit_strains(const std::vector<Fitted>& fitted) {
    begin("least squares");
    const auto n = static_cast<Eigen::Index>(fitted.size());
    Eigen::VectorXd start(n), low(n), high(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Range& range = range_of(fitted[j]);
      start[j] = std::log(fit_.parameters.*fitted[j].member);
      low[j] = std::log(range.low) - start[j];
      high[j] = std::log(range.high) - start[j];
    }
    const auto parameters = [&](const Eigen::VectorXd& x) {
      Parameters p = fit_.parameters;
      for (Eigen::Index j = 0; j < n; ++j)
        p.*fitted[j].member = std::exp(start[j] + x[j]);
      return p;
    };
    const Minimum minimum =
        least_squares([&](const Eigen::VectorXd& x) { return weighted_residuals(parameters(x)); },
                      Eigen::VectorXd::Zero(n), low, high, difference, longest_step);
    fit_.parameters = parameters(minimum.x);
    StrainFit& s = fit_.strain_fit.emplace();
    s.chi_squared = minimum.r.squaredNorm();
    s.degrees_of_freedom = static_cast<int>(minimum.r.size() - n);
  }

  [[nodiscard]] const Range& range_of(const Fitted& which) const {
    if (which.member == &Parameters::T_scale)
      return plan_.T_scale;
    return which.member == &Parameters::exponent ? plan_.exponent : plan_.stiffness;
  }

  /// Of all volumes and strains, each by its error.
  [[nodiscard]] Eigen::VectorXd weighted_residuals(const Parameters& p) {
    move_curve(p);
    std::vector<double> r;
    for (const Observation& o : fit_.observations)
      r.push_back((model_.volume(p, o.loads) / o.target - 1.0) / plan_.errors.volume);
    const std::vector<double> strains = model_.strains(p, ed_loads(), es_loads());
    for (std::size_t i = 0; i < strains.size(); ++i)
      r.push_back((strains[i] - plan_.strains[i].value) / plan_.errors.strain);
    return Eigen::Map<const Eigen::VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()));
  }

  /// Gauss-Newton steps in the exponent along the line on which the scale keeps the end-diastolic
  /// volume, halved until the Klotz curve is nearer.
  void fit_exponent(const Fitted& scale, const Fitted& exponent) {
    begin("fit to the Klotz curve");
    Eigen::VectorXd r = residuals(fit_.parameters);
    for (int i = 0; i < most_corrections; ++i) {
      const double along = scale_along(scale, exponent, r[0]);
      const Eigen::VectorXd slope =
          (residuals(moved(scale, exponent, along, difference)) - r) / difference;
      const auto tail = Eigen::seq(1, Eigen::last);  // all but the end-diastolic point
      double step = -slope(tail).dot(r(tail)) / slope(tail).squaredNorm();
      step = std::clamp(step, -longest_step, longest_step);
      const double log_x = std::log(fit_.parameters.exponent);
      step = std::clamp(log_x + step, std::log(plan_.exponent.low), std::log(plan_.exponent.high)) -
             log_x;
      while (std::abs(step) >= converged && !nearer(scale, exponent, along, step, r))
        step *= 0.5;
      if (std::abs(step) < converged)
        return;
    }
    throw RunError("The fit of scale and exponent to the Klotz curve does not converge",
                   "Set calibrate.passive = \"scale\", which the end-diastolic volume determines");
  }

  /// d ln scale/d ln exponent at constant end-diastolic volume, which is off by `misfit`.
  double scale_along(const Fitted& scale, const Fitted& exponent, double misfit) {
    const auto slope = [&](const Fitted& which) {
      Parameters p = fit_.parameters;
      p.*which.member *= std::exp(difference);
      return model_.volume(p, ed_loads()) / plan_.edv.volume - 1.0 - misfit;
    };
    return -slope(exponent) / slope(scale);
  }

  [[nodiscard]] Parameters moved(const Fitted& scale, const Fitted& exponent, double along,
                                 double step) const {
    Parameters p = fit_.parameters;
    p.*exponent.member *= std::exp(step);
    p.*scale.member *= std::exp(along * step);
    return p;
  }

  /// Takes a step if it brings the model nearer to the Klotz curve.
  bool nearer(const Fitted& scale, const Fitted& exponent, double along, double step,
              Eigen::VectorXd& r) {
    const Parameters before = fit_.parameters;
    try {
      fit_.parameters = moved(scale, exponent, along, step);
      keep_edv(scale);
      const Eigen::VectorXd r_next = residuals(fit_.parameters);
      if (r_next.squaredNorm() < r.squaredNorm()) {
        r = r_next;
        return true;
      }
    } catch (const RunError&) {  // no equilibrium there
    }
    fit_.parameters = before;
    return false;
  }

  /// Of the filling: V/V_k - 1.
  [[nodiscard]] Eigen::VectorXd residuals(const Parameters& p) {
    move_curve(p);
    Eigen::VectorXd r(1 + static_cast<Eigen::Index>(pressure_ratios.size()));
    for (Eigen::Index k = 0; k < r.size(); ++k) {
      const Observation& o = fit_.observations[k];
      r[k] = model_.volume(p, o.loads) / o.target - 1.0;
    }
    return r;
  }

  /// The model's volumes with the fitted parameters. Tension at rest makes the end-diastolic volume
  /// depend on T_scale a little.
  void measure() {
    begin("result");
    move_curve(fit_.parameters);
    fit_.unloaded_volume = model_.unloaded_volume(fit_.parameters);
    fit_.edv = model_.volume(fit_.parameters, ed_loads());
    for (const Observation& o : fit_.observations)
      fit_.volumes.push_back(o.name == "EDV" ? fit_.edv : model_.volume(fit_.parameters, o.loads));
    if (plan_.active)
      fit_.esv = fit_.volumes.back();
    if (fit_.strain_fit) {
      measure_strains(*fit_.strain_fit);
      return;  // a compromise, whose volumes are reported and need not be met
    }
    if (plan_.passive != Passive::none)
      check("end-diastolic", fit_.edv, plan_.edv.volume);
    if (plan_.active)
      check("end-systolic", fit_.esv, plan_.esv.volume);
  }

  void measure_strains(StrainFit& s) const {
    s.strains = model_.strains(fit_.parameters, ed_loads(), es_loads());
    double squares = 0.0;
    for (std::size_t i = 0; i < s.strains.size(); ++i) {
      const double off = s.strains[i] - plan_.strains[i].value;
      s.bias += off / static_cast<double>(s.strains.size());
      squares += off * off;
    }
    s.rms = std::sqrt(squares / static_cast<double>(s.strains.size()));
  }

  void check(const std::string& which, double volume, double target) const {
    if (std::abs(volume / target - 1.0) > plan_.tolerance)
      throw RunError(fmt::format("The fitted model's {} volume is {:.2f} ml and misses {:.2f} ml "
                                 "by more than calibrate.tolerance",
                                 which, 1e-3 * volume, 1e-3 * target),
                     "Widen the ranges in [calibrate], or set calibrate.passive = \"scale\"");
  }

  const Plan& plan_;
  Model model_;
  FitForecast forecast_;
  std::string purpose_;
  Fit fit_;
};

}  // namespace

Fit fit(const Model& model, const Parameters& start, const Plan& plan) {
  return Fitter(model, start, plan).run();
}

}  // namespace lv::calibrate
