#include "lv/calibrate/fit.hpp"

#include "lv/base/check.hpp"
#include "lv/base/dense.hpp"
#include "lv/base/log.hpp"
#include "lv/base/time_left.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/fit_out_of_reach.hpp"
#include "lv/calibrate/fit_parts.hpp"
#include "lv/calibrate/klotz.hpp"
#include "lv/calibrate/least_squares.hpp"
#include "lv/calibrate/posterior.hpp"
#include "lv/calibrate/unloaded_root.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <type_traits>

namespace lv::calibrate {
namespace {

using solid::Loads;

/// Volumes are met this much better than asked; unloading leaves them scattered by less.
constexpr double margin = 5e-3;

constexpr std::array<double, 3> pressure_ratios{0.25, 0.5, 2.0};  // to the end-diastolic one

/// Of the measured point against the Klotz curve, which only tells where on the line of equal
/// end-diastolic volumes the parameters are.
constexpr double weight_of_edv = 1e3;

/// The same, below it, for a shape of end-diastole; and how V0 weighs against them.
constexpr std::array<double, 2> ratios_below{0.25, 0.5};
constexpr double weight_of_unloaded = 3.0;
constexpr double rough = 0.03;           // a first V0, as a fraction
constexpr double rough_esv = 0.02;       // of ln(V/V_target), with a first T_scale
constexpr double first_stiffness = 2.0;  // stiff walls are unloaded more easily
constexpr double shortest_step = 5e-3;   // of the logarithms of scale and exponent
constexpr double shortest_of_regions = 1e-4;
constexpr double negligible_of_segments = 1e-2;               // decrease of |r|^2
constexpr std::array<double, 2> segment_factors{0.02, 50.0};  // within which they are sought
constexpr double unloaded_difference = 0.05;                  // unloading leaves volumes scattered

/// First steps of a bracket.
constexpr double far = 1.5;
constexpr double near = 1.05;

// logarithms of the exponent
constexpr double difference = 1e-2;  // for derivatives
constexpr double longest_step = 0.25;
constexpr double converged = 1e-3;
constexpr int most_corrections = 20;

class Fitter {
 public:
  Fitter(const Model& model, const FitParameters& start, const Plan& plan, FitForecast& forecast)
      : plan_(plan), model_(model), forecast_(forecast) {
    forecast_.begin_mesh(parts_of(plan));
    fit_.parameters = start;
    fit_.slopes = plan.slopes;
    if (plan.strains.empty())
      model_.strains = {};
    else
      model_.strains = [this, &model](const FitParameters& p, const Loads& ed, const Loads& es) {
        return measured(Sought::contracts_again, [&] { return model.strains(p, ed, es); });
      };
    if (plan.drawn.empty())
      model_.distances = {};
    else
      model_.distances = [this, &model](const FitParameters& p, const Loads& es) {
        return measured(Sought::contracts_again, [&] { return model.distances(p, es); });
      };
    model_.volume = [this, &model](const FitParameters& p, const Loads& loads) {
      auto volume = measured(sought(p, loads), [&] { return model.volume(p, loads); });
      last_ = p;
      if (!volume)
        return volume;
      if (sought_ && purpose_ != of_curve)
        forecast_.bracket(std::log(*volume / sought_->volume), sought_->accuracy,
                          sought_->first_step);
      fit_.history.push_back({purpose_, p, loads, *volume});
      log::info(
          "{:<22} C_a {:.4g}  scale {:.4g}  exponent {:.4g}  T_scale {:.4g}  {:.2f} mmHg  "
          "{:.3f} ml{}",
          purpose_, p.C_a, p.scale, p.exponent, p.T_scale, loads.pressure / units::mmHg,
          1e-3 * *volume, time_left(forecast_.seconds_left()));
      quiet_ = TimeLeft();
      return volume;
    };
    if (model_.tell)
      model_.tell([this](const Loads& loads, double share) { say_on_the_way(loads, share); });
  }
  ~Fitter() {
    if (model_.tell)
      model_.tell({});
  }
  Fitter(const Fitter&) = delete;
  Fitter& operator=(const Fitter&) = delete;

  [[nodiscard]] const FitParameters& parameters() const { return fit_.parameters; }

  Fit run() {
    observe();
    std::vector<Fitted> fitted;
    if (plan_.passive != FittedPassive::none)
      fitted.push_back(plan_.passive == FittedPassive::C_a
                           ? Fitted{"C_a", &FitParameters::C_a}
                           : Fitted{"scale", &FitParameters::scale});
    if (plan_.fits_exponent())
      fitted.push_back({"exponent", &FitParameters::exponent});
    fit_passive(fitted, plan_.starts_near ? near : far);
    if (plan_.active) {
      if (fitted.empty())
        check_filling();
      fitted.push_back(tension_);
      bracket(tension_, plan_.T_scale, es_loads(), plan_.esv,
              plan_.starts_near || has_tension_ ? near : far);
      // with the tension at rest, the end-diastolic volume has moved a little
      fit_passive(fitted, near);
      bracket(fitted.back(), plan_.T_scale, es_loads(), plan_.esv, near);
    }
    if (plan_.fits_regions())
      fit_regions(fitted);
    measure();
    if (plan_.parameters_alone)
      return std::move(fit_);
    begin(of_sensitivity);
    fit_.sensitivity = sensitivity(model_, fit_.parameters, fitted, fit_.observations,
                                   {plan_.edv.volume, ed_loads(), es_loads(), plan_.errors});
    if (!fit_.segments.empty())
      know_segments();
    return std::move(fit_);
  }

 private:
  /// Of ln(V/V_target), where a bracket ends.
  [[nodiscard]] double accuracy() const { return margin * plan_.tolerance; }
  [[nodiscard]] Loads ed_loads() const { return {plan_.ed_pressure, 0.0}; }
  [[nodiscard]] Loads es_loads() const { return {plan_.es_pressure, 1.0}; }

  void begin(const std::string& purpose) {
    purpose_ = purpose;
    forecast_.begin(purpose);
  }

  [[nodiscard]] Sought sought(const FitParameters& p, const Loads& loads) const {
    if (loads.activation > 0.0)
      return p == last_ ? Sought::contracts_again : Sought::contracts_anew;
    return p == last_ ? Sought::rests_again : Sought::rests_anew;
  }

  template <class Ask>
  std::invoke_result_t<Ask> measured(Sought which, const Ask& ask) {
    present_ = {which, so_far()};
    auto answer = ask();
    forecast_.record(which, since_present());
    return answer;
  }

  [[nodiscard]] Effort so_far() const {
    const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
    return {now.count(), model_.work ? model_.work() : Work{}};
  }
  [[nodiscard]] Effort since_present() const {
    const Effort now = so_far();
    return {now.seconds - present_.began.seconds,
            {now.work.all - present_.began.work.all,
             now.work.polishing - present_.began.work.polishing}};
  }

  void say_on_the_way(const Loads& loads, double share) {
    forecast_.on_the_way(present_.which, since_present(), share);
    if (share < 1.0 && quiet_.due())
      log::info("{:.0f}% of the way to {:.2f} mmHg and {:.0f}% of the active tension{}",
                100.0 * share, loads.pressure / units::mmHg, 100.0 * loads.activation,
                time_left(forecast_.seconds_left()));
  }

  /// Of `fitted`, the passive parameters.
  void fit_passive(const std::vector<Fitted>& fitted, double first_factor) {
    if (plan_.passive == FittedPassive::none)
      return;
    if (plan_.passive == FittedPassive::klotz) {
      fit_klotz({fitted[0], fitted[1]}, first_factor == far);
      return;
    }
    bracket(fitted.front(), plan_.stiffness, ed_loads(), plan_.edv, first_factor);
    if (plan_.passive == FittedPassive::scale_and_exponent) {
      if (first_factor == far)
        try_contraction();
      fit_exponent(fitted[0], fitted[1]);
    }
  }

  /// Of muscle that was not fitted to an end-diastolic volume.
  void check_filling() {
    begin(of_filling);
    const double edv = model_.volume(fit_.parameters, ed_loads()).value();
    const double missing = std::log(plan_.esv.volume / edv);
    if (missing >= 0.0)
      throw OutOfReach(
          plan_.esv.origin,
          fmt::format("{:.2f} ml cannot be reached by contraction: this muscle fills to {:.2f} ml "
                      "at {:.2f} mmHg, so nothing would be ejected",
                      1e-3 * plan_.esv.volume, 1e-3 * edv, plan_.ed_pressure / units::mmHg),
          "Check this volume, protocol.ed_pressure and the stiffness, which calibrate.passive can "
          "fit to a measured end-diastolic volume",
          missing);
  }

  /// A first T_scale with the stiffness that is known so far. Throws OutOfReach where the
  /// end-systolic volume is beyond what the muscle reaches by more than the margin.
  void try_contraction() {
    if (!plan_.active)
      return;
    begin(of_first_tension);
    const double start = fit_.parameters.T_scale;
    try {
      has_tension_ =
          static_cast<bool>(solve(tension_, plan_.T_scale, es_loads(), plan_.esv, far, rough_esv));
    } catch (const OutOfReach& failure) {
      if (failure.missing() > reach_margin)
        throw failure.found(
            fmt::format(" (a first try, with the stiffness known roughly: at the end of the range "
                        "{:.0f}% are missing, and the rest of the fit may gain {:.0f}%)",
                        100.0 * failure.missing(), 100.0 * reach_margin));
      if (failure.missing() > 0.0)
        log::warn(
            "{}: a first try, with the stiffness known roughly, misses it by {:.1f}%. The fit "
            "goes on, since the rest of it may gain {:.0f}%",
            failure.what(), 100.0 * failure.missing(), 100.0 * reach_margin);
    }
    if (!has_tension_)
      fit_.parameters.T_scale = start;
  }

  void bracket(const Fitted& which, const Range& range, const Loads& loads, const Target& target,
               double first_factor) {
    begin(bracket_of(which.name));
    solve(which, range, loads, target, first_factor, accuracy()).value();
  }

  /// Brings the scale back to the measured end-diastolic volume after a small change.
  Outcome<double> keep_edv(const Fitted& scale) {
    return solve(scale, plan_.stiffness, ed_loads(), plan_.edv, near, accuracy());
  }

  /// Where the target is out of reach the parameter is left where it comes nearest.
  Outcome<double> solve(const Fitted& which, const Range& range, const Loads& loads,
                        const Target& target, double first_factor, double accuracy) {
    FitParameters& p = fit_.parameters;
    const double start = p.*which.member;
    double nearest = start;
    double least = std::numeric_limits<double>::infinity();
    const auto volume = [&](double x) {
      p.*which.member = x;
      sought_ = {target.volume, accuracy, std::log(first_factor)};
      auto found = model_.volume(p, loads);
      sought_.reset();
      const double misfit = found ? std::abs(std::log(*found / target.volume)) : least;
      if (misfit < least) {
        nearest = x;
        least = misfit;
      }
      return found;
    };
    try {
      auto root = find_root(volume, {which.name, start, range, first_factor}, target, accuracy);
      if (root)
        p.*which.member = *root;
      return root;
    } catch (const OutOfReach&) {
      p.*which.member = nearest;
      throw;
    }
  }

  /// Scale and exponent of a shape of end-diastole: first the scale alone, roughly.
  void fit_klotz(const std::vector<Fitted>& fitted, bool first) {
    begin(of_unloaded);
    FitParameters& p = fit_.parameters;
    if (first || (plan_.starts_near && !model_.volume(p, {}))) {
      p.scale *= first_stiffness;
      reach_unloaded_volume(p.scale * stiffer_by(), rough);
      try_contraction();
    }
    begin(of_curve);
    const Logarithms logs = logarithms(fitted);
    const auto residuals = [&](const Eigen::VectorXd& x) -> Outcome<Eigen::VectorXd> {
      const auto r = misfits(moved_to(fitted, x), 1 + ratios_below.size());
      if (!r)
        return r.why();
      Eigen::VectorXd weighted = dense::as_vector(*r);
      weighted[0] *= weight_of_unloaded;
      return weighted;
    };
    const auto minimum = least_squares(residuals, logs.start, logs.low, logs.high,
                                       {unloaded_difference, longest_step, shortest_step,
                                        fit_.slopes, [&](double n) { forecast_.expect(n); }});
    p = moved_to(fitted, minimum.value().x);
    fit_.slopes = minimum->slopes;
    // where no exponent brings the curve near, V0 must not pay for it
    if (std::abs(minimum->r[0]) > 0.5 * plan_.tolerance * weight_of_unloaded)
      reach_unloaded_volume(p.scale, 0.25 * plan_.tolerance);
  }

  /// What the scale has to grow by for the wall without load, folded or not, to hold V0, where that
  /// is more than one: no smooth one is sought where softer muscle folds in vain.
  [[nodiscard]] double stiffer_by() const {
    if (!model_.share_that_leaves)
      return 1.0;
    const auto share = model_.share_that_leaves(fit_.parameters, fit_.observations.front().target);
    return share ? 1.0 / *share : 1.0;
  }

  /// By the scale alone.
  void reach_unloaded_volume(double start, double accuracy) {
    FitParameters& p = fit_.parameters;
    p.scale = find_unloaded_root(
        [&](double x) {
          p.scale = x;
          return model_.volume(p, {});
        },
        {"scale", start, plan_.stiffness, far},
        {fit_.observations.front().target, plan_.edv.origin}, plan_.edv.volume, accuracy,
        model_.folded_volume);
  }

  /// Of the passive parameters, or of all.
  struct Logarithms {
    Eigen::VectorXd start, low, high;
  };
  [[nodiscard]] Logarithms logarithms(const std::vector<Fitted>& fitted) const {
    std::vector<double> start, low, high;
    for (const Fitted& which : fitted) {
      start.push_back(std::log(fit_.parameters.*which.member));
      low.push_back(std::log(range_of(which).low));
      high.push_back(std::log(range_of(which).high));
    }
    return {dense::as_vector(start), dense::as_vector(low), dense::as_vector(high)};
  }
  [[nodiscard]] FitParameters moved_to(const std::vector<Fitted>& fitted,
                                       const Eigen::VectorXd& x) const {
    FitParameters p = fit_.parameters;
    const auto n = static_cast<Eigen::Index>(fitted.size());
    for (Eigen::Index j = 0; j < n; ++j)
      p.*fitted[j].member = std::exp(x[j]);
    for (Eigen::Index j = n; j < x.size(); ++j)
      p.segments[plan_.segments[j - n] - 1] = std::exp(x[j]);
    return p;
  }

  /// V0 and the filling curve by Klotz et al. for a shape of end-diastole.
  void observe_klotz() {
    const double V_m = plan_.edv.volume;
    const double V_0 = klotz(V_m, plan_.ed_pressure).V0;
    fit_.observations.push_back({"Klotz, V0", {}, V_0, weight_of_unloaded, 0.0, V_0 / V_m});
    for (const double ratio : ratios_below) {
      const double V = V_0 + (V_m - V_0) * klotz_filling(ratio);
      fit_.observations.push_back({fmt::format("Klotz, {:g} p_ED", ratio),
                                   {ratio * plan_.ed_pressure, 0.0},
                                   V,
                                   1.0,
                                   ratio,
                                   V / V_m});
    }
  }

  /// The measured points, and the Klotz curve where it is fitted to.
  void observe() {
    const double edv = plan_.edv.volume;
    if (plan_.passive == FittedPassive::klotz)
      observe_klotz();
    const bool curve = plan_.passive == FittedPassive::scale_and_exponent;
    auto& list = fit_.observations;
    if (plan_.passive != FittedPassive::none && plan_.passive != FittedPassive::klotz)
      list.push_back(
          {"EDV", ed_loads(), edv, curve && !plan_.fits_regions() ? weight_of_edv : 1.0, 1.0, 1.0});
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

  /// The Klotz curve starts from the model's volume without load; why there is none, if so.
  [[nodiscard]] std::optional<Unsolved> move_curve(const FitParameters& p) {
    for (ObservedVolume& o : fit_.observations) {
      if (o.target_by_unloaded == 0.0)
        continue;
      const auto V_0 = model_.unloaded_volume(p);
      if (!V_0)
        return V_0.why();
      o.target = o.target_by_unloaded * *V_0 + o.target_by_edv * plan_.edv.volume;
    }
    return {};
  }

  /// V/V_k - 1 of the first observations.
  Outcome<std::vector<double>> misfits(const FitParameters& p, std::size_t count) {
    if (const auto why = move_curve(p))
      return *why;
    std::vector<double> r;
    for (std::size_t k = 0; k < count; ++k) {
      const ObservedVolume& o = fit_.observations[k];
      const auto volume = model_.volume(p, o.loads);
      if (!volume)
        return volume.why();
      r.push_back(*volume / o.target - 1.0);
    }
    return r;
  }

  /// By the logarithms of the parameters, and of the segments' factors, with their penalty.
  void fit_regions(const std::vector<Fitted>& fitted) {
    begin(of_regions);
    std::optional<ShapeFit> shape;
    if (model_.distances)
      shape = ShapeFit{{}, misfit_of_shape(distances()), {}};
    const Logarithms logs = with_segments(logarithms(fitted));
    const auto segments = static_cast<Eigen::Index>(plan_.segments.size());
    const auto residuals = [&](const Eigen::VectorXd& x) -> Outcome<Eigen::VectorXd> {
      const auto r = weighted_residuals(moved_to(fitted, x));
      if (!r)
        return r.why();
      Eigen::VectorXd all(r->size() + segments);
      all << *r, x.tail(segments) / plan_.spread;
      return all;
    };
    const Minimum minimum =
        least_squares(residuals, logs.start, logs.low, logs.high,
                      {.difference = difference,
                       .longest = longest_step,
                       .shortest = shortest_of_regions,
                       .negligible = segments > 0 ? negligible_of_segments : 0.0,
                       .confirms = true,
                       .linearise = [&](const auto& x) { linearise(fitted, x); }})
            .value();
    if (!minimum.is_found)
      throw NoSolution(fmt::format("The fit to what was measured of regions did not come to an end "
                                   "in {} equilibria, |r| = {:.4g}",
                                   minimum.evaluations, minimum.r.norm()),
                       "Fit fewer parameters, or start nearer to the values that are expected");
    fit_.parameters = moved_to(fitted, minimum.x);
    posterior_ = posterior(minimum.slopes, segments);
    RegionalFit& f = fit_.regional_fit.emplace();
    const Eigen::Index rows = minimum.r.size() - segments;
    const Eigen::Index data = rows - count_silent(minimum.r.head(rows));
    f.chi_squared = minimum.r.head(rows).squaredNorm();
    f.degrees_of_freedom = static_cast<double>(data) - posterior_.resolution.sum();
    f.shape = std::move(shape);
    constexpr double few = 0.25;  // of the data: nothing is left that would show a too small error
    if (segments > 0 && f.degrees_of_freedom < few * static_cast<double>(data))
      log::warn(
          "{} data determine {:.1f} unknowns: the factors of segments fit their noise too, and "
          "their intervals hang on calibrate.strain_error = {:g} alone, which followed images "
          "hardly reach below 0.02. Give the error that the strains have, or a smaller "
          "calibrate.contractility_spread",
          data, posterior_.resolution.sum(), plan_.errors.strain);
    const double misfit = std::sqrt(std::max(1.0, f.chi_squared / f.degrees_of_freedom));
    Eigen::MatrixXd slopes = minimum.slopes;
    slopes.topRows(rows) /= misfit;
    const Eigen::MatrixXd covariance = posterior(slopes, segments).covariance;
    for (Eigen::Index j = 0; j < segments; ++j) {
      const Eigen::Index at = minimum.x.size() - segments + j;
      fit_.segments.push_back({plan_.segments[j], std::exp(minimum.x[at]),
                               std::sqrt(covariance(at, at)), posterior_.resolution[at]});
    }
  }

  void linearise(const std::vector<Fitted>& fitted, const std::optional<Eigen::VectorXd>& x) {
    if (model_.linearise && !plan_.segments.empty())
      model_.linearise(x ? std::optional(moved_to(fitted, *x)) : std::nullopt);
  }

  [[nodiscard]] Logarithms with_segments(Logarithms logs) const {
    const Eigen::Index n = logs.start.size();
    const auto all = n + static_cast<Eigen::Index>(plan_.segments.size());
    for (Eigen::VectorXd* values : {&logs.start, &logs.low, &logs.high})
      values->conservativeResize(all);
    for (Eigen::Index j = n; j < all; ++j) {
      logs.start[j] = std::log(fit_.parameters.segments[plan_.segments[j - n] - 1]);
      logs.low[j] = std::log(segment_factors.front());
      logs.high[j] = std::log(segment_factors.back());
    }
    return logs;
  }

  /// The errors of the other parameters, which hang on those of the segments.
  void know_segments() {
    Sensitivity& s = fit_.sensitivity;
    const Eigen::Index n = s.covariance.rows();
    s.covariance = posterior_.covariance.topLeftCorner(n, n);
    s.correlation = correlation(s.covariance);
  }

  [[nodiscard]] std::vector<double> distances() const {
    return model_.distances(fit_.parameters, es_loads()).value();
  }

  /// Of `count` of the values; the others are zero.
  static Misfit misfit_of(const std::vector<double>& off, std::size_t count) {
    const Eigen::VectorXd v = dense::as_vector(off);
    const auto n = static_cast<double>(count);
    return {v.norm() / std::sqrt(n), v.sum() / n};
  }

  /// Parts above the base say nothing, and are at no distance.
  static Misfit misfit_of_shape(const std::vector<double>& off) {
    return misfit_of(off, counted_parts(off));
  }

  /// Of all residuals but the penalties, those of drawn parts above the base; distances are last.
  [[nodiscard]] Eigen::Index count_silent(const Eigen::VectorXd& r) const {
    return (r.tail(static_cast<Eigen::Index>(plan_.drawn.size())).array() == 0.0).count();
  }

  [[nodiscard]] const Range& range_of(const Fitted& which) const {
    if (which.member == &FitParameters::T_scale)
      return plan_.T_scale;
    return which.member == &FitParameters::exponent ? plan_.exponent : plan_.stiffness;
  }

  /// Of all volumes, strains and distances, each by its error.
  Outcome<Eigen::VectorXd> weighted_residuals(const FitParameters& p) {
    const auto of_volumes = misfits(p, fit_.observations.size());
    if (!of_volumes)
      return of_volumes.why();
    std::vector<double> r;
    for (const double misfit : *of_volumes)
      r.push_back(misfit / plan_.errors.volume);
    if (model_.strains) {
      const auto strains = model_.strains(p, ed_loads(), es_loads());
      if (!strains)
        return strains.why();
      for (std::size_t i = 0; i < strains->size(); ++i)
        r.push_back(((*strains)[i] - plan_.strains[i].value) / plan_.errors.strain);
    }
    if (model_.distances) {
      const auto distances = model_.distances(p, es_loads());
      if (!distances)
        return distances.why();
      for (const double distance : *distances)
        r.push_back(distance / plan_.errors.shape);
    }
    return dense::as_vector(r);
  }

  /// Gauss-Newton steps in the exponent along the line on which the scale keeps the end-diastolic
  /// volume, halved until the Klotz curve is nearer.
  void fit_exponent(const Fitted& scale, const Fitted& exponent) {
    begin(of_curve);
    Eigen::VectorXd r = residuals(fit_.parameters).value();
    for (int i = 0; i < most_corrections; ++i) {
      const double along = scale_along(scale, exponent, r[0]);
      const Eigen::VectorXd slope =
          (residuals(moved(scale, exponent, along, difference)).value() - r) / difference;
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
    throw NoSolution(
        "The fit of scale and exponent to the Klotz curve does not converge",
        "Set calibrate.passive = \"scale\", which the end-diastolic volume determines");
  }

  /// d ln scale/d ln exponent at constant end-diastolic volume, which is off by `misfit`.
  double scale_along(const Fitted& scale, const Fitted& exponent, double misfit) {
    const auto slope = [&](const Fitted& which) {
      FitParameters p = fit_.parameters;
      p.*which.member *= std::exp(difference);
      return model_.volume(p, ed_loads()).value() / plan_.edv.volume - 1.0 - misfit;
    };
    return -slope(exponent) / slope(scale);
  }

  [[nodiscard]] FitParameters moved(const Fitted& scale, const Fitted& exponent, double along,
                                    double step) const {
    FitParameters p = fit_.parameters;
    p.*exponent.member *= std::exp(step);
    p.*scale.member *= std::exp(along * step);
    return p;
  }

  /// Takes a step if it brings the model nearer to the Klotz curve.
  bool nearer(const Fitted& scale, const Fitted& exponent, double along, double step,
              Eigen::VectorXd& r) {
    const FitParameters before = fit_.parameters;
    fit_.parameters = moved(scale, exponent, along, step);
    if (keep_edv(scale)) {
      const auto r_next = residuals(fit_.parameters);
      if (r_next && r_next->squaredNorm() < r.squaredNorm()) {
        r = *r_next;
        return true;
      }
    }
    fit_.parameters = before;
    return false;
  }

  /// Of the filling.
  Outcome<Eigen::VectorXd> residuals(const FitParameters& p) {
    const auto r = misfits(p, 1 + pressure_ratios.size());
    if (!r)
      return r.why();
    return dense::as_vector(*r);
  }

  /// The model's volumes with the fitted parameters. Tension at rest makes the end-diastolic volume
  /// depend on T_scale a little.
  void measure() {
    begin(of_result);
    fit_.unloaded_volume = model_.unloaded_volume(fit_.parameters).value();
    static_cast<void>(move_curve(fit_.parameters));
    fit_.edv = model_.volume(fit_.parameters, ed_loads()).value();
    for (const ObservedVolume& o : fit_.observations)
      fit_.volumes.push_back(o.name == "EDV" ? fit_.edv
                                             : model_.volume(fit_.parameters, o.loads).value());
    if (plan_.active)
      fit_.esv = fit_.volumes.back();
    if (fit_.regional_fit) {
      measure_regions(*fit_.regional_fit);
      return;  // a compromise, whose volumes are reported and need not be met
    }
    if (plan_.passive == FittedPassive::klotz)
      check("unloaded", fit_.volumes.front(), fit_.observations.front().target);
    else if (plan_.passive != FittedPassive::none)
      check("end-diastolic", fit_.edv, plan_.edv.volume);
    if (plan_.active)
      check("end-systolic", fit_.esv, plan_.esv.volume);
  }

  void measure_regions(RegionalFit& f) const {
    if (model_.strains) {
      f.strains = model_.strains(fit_.parameters, ed_loads(), es_loads()).value();
      std::vector<double> off;
      for (std::size_t i = 0; i < f.strains.size(); ++i)
        off.push_back(f.strains[i] - plan_.strains[i].value);
      f.strain = misfit_of(off, off.size());
    }
    if (f.shape) {
      f.shape->distances = distances();
      f.shape->after = misfit_of_shape(f.shape->distances);
      log::info(
          "end-systolic surfaces lie {:.2f} mm rms ({:+.2f} in the mean) outside of the drawn "
          "ones, fitted to volumes alone {:.2f} mm ({:+.2f})",
          f.shape->after.rms, f.shape->after.bias, f.shape->before.rms, f.shape->before.bias);
    }
  }

  void check(const std::string& which, double volume, double target) const {
    if (std::abs(volume / target - 1.0) > plan_.tolerance)
      throw NoSolution(fmt::format("The fitted model's {} volume is {:.2f} ml and misses {:.2f} ml "
                                   "by more than calibrate.tolerance",
                                   which, 1e-3 * volume, 1e-3 * target),
                       plan_.passive == FittedPassive::klotz
                           ? "Widen the ranges in [calibrate], or check unloaded.pressure"
                           : "Widen the ranges in [calibrate], or set calibrate.passive = "
                             "\"scale\"");
  }

  const Plan& plan_;
  Model model_;
  FitForecast& forecast_;
  std::string purpose_;
  struct Root {
    double volume, accuracy, first_step;
  };
  std::optional<Root> sought_;  ///< while a bracket asks
  struct Present {
    Sought which = Sought::rests_anew;
    Effort began;
  } present_;
  TimeLeft quiet_;
  FitParameters last_{.C_a = 0.0};  ///< of the last equilibrium
  bool has_tension_ = false;        ///< T_scale is near its end
  Fitted tension_{"T_scale", &FitParameters::T_scale};
  Posterior posterior_;  ///< of the fit to strains
  Fit fit_;
};

}  // namespace

Fit fit(const Model& model, const FitParameters& start, const Plan& plan, FitForecast& forecast) {
  Fitter fitter(model, start, plan, forecast);
  try {
    return fitter.run();
  } catch (const OutOfReach& failure) {
    throw FitOutOfReach(failure, fitter.parameters());
  }
}

Fit fit(const Model& model, const FitParameters& start, const Plan& plan) {
  FitForecast forecast(std::vector<FittedMesh>(1));
  return fit(model, start, plan, forecast);
}

}  // namespace lv::calibrate
