#include "lv/calibrate/fit.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/klotz.hpp"

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include <array>
#include <cmath>

namespace lv::calibrate {
namespace {

using quasi_static::Loads;

/// Volumes are met this much better than asked.
constexpr double margin = 1e-3;

constexpr std::array<double, 3> pressure_ratios{0.25, 0.5, 2.0};  // to the end-diastolic one
constexpr double weight_of_edv = 20.0;

constexpr double difference = 1e-3;  // of a logarithm, for derivatives
constexpr double converged = 1e-4;   // correction of a logarithm
constexpr int most_corrections = 30;
constexpr double stiffest_damping = 1e6;

class Fitter {
 public:
  Fitter(const Model& model, const Parameters& start, const Plan& plan) : plan_(plan) {
    fit_.parameters = start;
    model_ = [this, &model](const Parameters& p, const Loads& loads) {
      const double volume = model(p, loads);
      fit_.history.push_back({purpose_, p, loads, volume});
      log::info(
          "{:<22} C_a {:.4g}  scale {:.4g}  exponent {:.4g}  T_scale {:.4g}  {:.2f} mmHg  "
          "{:.3f} ml",
          purpose_, p.C_a, p.scale, p.exponent, p.T_scale, loads.pressure / units::mmHg,
          1e-3 * volume);
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
    fit_passive(fitted);
    if (plan_.active) {
      fitted.push_back({"T_scale", &Parameters::T_scale});
      bracket(fitted.back(), plan_.T_scale, es_loads(), plan_.esv);
      // with the tension at rest, the end-diastolic volume has moved a little
      fit_passive(fitted);
      bracket(fitted.back(), plan_.T_scale, es_loads(), plan_.esv);
    }
    measure();
    purpose_ = "sensitivity";
    fit_.sensitivity =
        sensitivity(model_, fit_.parameters, fitted, fit_.observations, plan_.edv.volume);
    return std::move(fit_);
  }

 private:
  [[nodiscard]] Loads ed_loads() const { return {plan_.ed_pressure, 0.0}; }
  [[nodiscard]] Loads es_loads() const { return {plan_.es_pressure, 1.0}; }

  /// Of `fitted`, the passive parameters.
  void fit_passive(const std::vector<Fitted>& fitted) {
    if (plan_.passive == Passive::none)
      return;
    bracket(fitted.front(), plan_.stiffness, ed_loads(), plan_.edv);
    if (plan_.passive == Passive::scale_and_exponent)
      least_squares({fitted[0], fitted[1]});
  }

  void bracket(const Fitted& which, const Range& range, const Loads& loads, const Target& target) {
    purpose_ = fmt::format("bracket of {}", which.name);
    Parameters& p = fit_.parameters;
    const auto volume = [&](double x) {
      p.*which.member = x;
      return model_(p, loads);
    };
    p.*which.member =
        find_root(volume, {which.name, p.*which.member, range}, target, margin * plan_.tolerance);
  }

  /// The measured points, and the Klotz curve where it is fitted to.
  void observe() {
    const double V_0 = plan_.unloaded_volume;
    const double edv = plan_.edv.volume;
    const bool curve = plan_.passive == Passive::scale_and_exponent;
    auto& list = fit_.observations;
    if (plan_.passive != Passive::none)
      list.push_back({"EDV", ed_loads(), edv, curve ? weight_of_edv : 1.0, 1.0, 1.0});
    if (curve)
      for (const double ratio : pressure_ratios) {
        const double filling = klotz_filling(ratio);
        list.push_back({fmt::format("Klotz, {:g} p_ED", ratio),
                        {ratio * plan_.ed_pressure, 0.0},
                        V_0 + (edv - V_0) * filling,
                        1.0,
                        ratio,
                        filling});
      }
    if (plan_.active)
      list.push_back({"ESV", es_loads(), plan_.esv.volume});
  }

  /// Levenberg's damping of Gauss-Newton steps; no parameter leaves its range.
  void least_squares(const std::vector<Fitted>& unknowns) {
    purpose_ = "fit to the Klotz curve";
    const std::array<Range, 2> ranges{plan_.stiffness, plan_.exponent};
    Eigen::VectorXd r = residuals(fit_.parameters);
    double damping = 1e-3;
    for (int i = 0; i < most_corrections; ++i) {
      const Eigen::MatrixXd J = jacobian(unknowns, r);
      while (true) {
        Eigen::MatrixXd A = J.transpose() * J;
        A.diagonal() *= 1.0 + damping;
        const Eigen::VectorXd step = -A.ldlt().solve(J.transpose() * r);
        Parameters next = fit_.parameters;
        double length = 0.0;
        for (Eigen::Index j = 0; j < step.size(); ++j) {
          double& x = next.*unknowns[j].member;
          const double before = x;
          x = std::clamp(x * std::exp(step[j]), ranges[j].low, ranges[j].high);
          length = std::max(length, std::abs(std::log(x / before)));
        }
        const Eigen::VectorXd r_next = length > 0.0 ? residuals(next) : r;
        const bool better = r_next.squaredNorm() < r.squaredNorm();
        if (better) {
          fit_.parameters = next;
          r = r_next;
          damping *= 0.1;
        }
        if (length < converged)
          return;
        if (better)
          break;
        damping *= 10.0;
        if (damping > stiffest_damping)
          return;
      }
    }
    throw RunError("The fit of scale and exponent to the Klotz curve does not converge",
                   "Set calibrate.passive = \"scale\", which the end-diastolic volume determines");
  }

  [[nodiscard]] Eigen::VectorXd residuals(const Parameters& p) {
    Eigen::VectorXd r(1 + static_cast<Eigen::Index>(pressure_ratios.size()));  // of the filling
    for (Eigen::Index k = 0; k < r.size(); ++k) {
      const Observation& o = fit_.observations[k];
      r[k] = o.weight * (model_(p, o.loads) / o.target - 1.0);
    }
    return r;
  }

  [[nodiscard]] Eigen::MatrixXd jacobian(const std::vector<Fitted>& unknowns,
                                         const Eigen::VectorXd& r) {
    Eigen::MatrixXd J(r.size(), static_cast<Eigen::Index>(unknowns.size()));
    for (Eigen::Index j = 0; j < J.cols(); ++j) {
      Parameters p = fit_.parameters;
      p.*unknowns[j].member *= std::exp(difference);
      J.col(j) = (residuals(p) - r) / difference;
    }
    return J;
  }

  /// The model's volumes with the fitted parameters. Tension at rest makes the end-diastolic volume
  /// depend on T_scale a little.
  void measure() {
    purpose_ = "result";
    fit_.edv = model_(fit_.parameters, ed_loads());
    for (const Observation& o : fit_.observations)
      fit_.volumes.push_back(o.name == "EDV" ? fit_.edv : model_(fit_.parameters, o.loads));
    if (plan_.passive != Passive::none)
      check("end-diastolic", fit_.edv, plan_.edv.volume);
    if (!plan_.active)
      return;
    fit_.esv = fit_.volumes.back();
    check("end-systolic", fit_.esv, plan_.esv.volume);
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
  std::string purpose_;
  Fit fit_;
};

}  // namespace

Fit fit(const Model& model, const Parameters& start, const Plan& plan) {
  return Fitter(model, start, plan).run();
}

}  // namespace lv::calibrate
