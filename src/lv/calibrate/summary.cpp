#include "lv/calibrate/summary.hpp"

#include "lv/base/dense.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/klotz.hpp"
#include "lv/calibrate/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::calibrate {
namespace {

using Json = nlohmann::ordered_json;
using units::mmHg;

/// Errors of measurements by which fitted values are moved: as fractions of the volumes [-], and
/// of the pressures [kPa].
constexpr double volume_error = 0.05;
constexpr double pressure_error = 2.0 * mmHg;
const std::array<std::string, 4> data_names{"EDV", "ESV", "p_ED", "p_ES"};
const std::array<double, 4> data_errors{volume_error, volume_error, pressure_error, pressure_error};
const std::array<std::string, 4> error_names{"EDV -+5%", "ESV -+5%", "p_ED -+2 mmHg",
                                             "p_ES -+2 mmHg"};

/// The measurements that a fit can be moved by. A shape of end-diastole is its own EDV, and is
/// fitted anew for other pressures.
std::vector<int> data_of(const Plan& plan) {
  return plan.passive == FittedPassive::klotz ? std::vector<int>{1, 3}
                                              : std::vector<int>{0, 1, 2, 3};
}

/// Beyond this correlation two parameters count as not told apart.
constexpr double alike = 0.9;

/// A combination of parameters less certain than this (of its logarithm) counts as left open.
constexpr double unknown = 0.5;

/// The fitted value when a measurement is off by its error, to first order of the logarithm.
double moved(const Fit& fit, Eigen::Index parameter, int data, double sign) {
  const Fitted& which = fit.sensitivity.parameters[parameter];
  return fit.parameters.*which.member *
         std::exp(sign * data_errors[data] * fit.sensitivity.by_data(parameter, data));
}

std::string volume_rows(const Fit& fit) {
  std::string text = fmt::format("  {:<18}{:>10}{:>14}{:>12}{:>9}{:>16}\n", "volume", "mmHg",
                                 "measured ml", "model ml", "off", "dV/dp ml/mmHg");
  for (std::size_t k = 0; k < fit.observations.size(); ++k) {
    const ObservedVolume& o = fit.observations[k];
    text += fmt::format("  {:<18}{:>10.2f}{:>14.2f}{:>12.2f}{:>8.2f}%{:>16.3f}\n", o.name,
                        o.loads.pressure / mmHg, 1e-3 * o.target, 1e-3 * fit.volumes[k],
                        100.0 * (fit.volumes[k] / o.target - 1.0),
                        1e-3 * mmHg * fit.sensitivity.by_pressure[static_cast<Eigen::Index>(k)]);
  }
  return text;
}

std::string parameter_rows(const Plan& plan, const Fit& fit) {
  std::string text = fmt::format("\n  {:<12}{:>10}", "parameter", "fitted");
  for (const int d : data_of(plan))
    text += fmt::format("{:>20}", error_names[d]);
  const auto& parameters = fit.sensitivity.parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    text += fmt::format("\n  {:<12}{:>10.4g}", parameters[j].name,
                        fit.parameters.*parameters[j].member);
    for (const int d : data_of(plan))
      text += fmt::format("{:>20}",
                          fmt::format("{:.3g} / {:.3g}", moved(fit, static_cast<int>(j), d, -1.0),
                                      moved(fit, static_cast<int>(j), d, 1.0)));
  }
  return text + "\n";
}

std::string derivative_rows(const Fit& fit) {
  std::string text = fmt::format("\n  {:<18}", "d ln V / d ln x");
  for (const Fitted& p : fit.sensitivity.parameters)
    text += fmt::format("{:>12}", p.name);
  for (std::size_t k = 0; k < fit.observations.size(); ++k) {
    text += fmt::format("\n  {:<18}", fit.observations[k].name);
    for (Eigen::Index j = 0; j < fit.sensitivity.by_parameter.cols(); ++j)
      text +=
          fmt::format("{:>12.4f}", fit.sensitivity.by_parameter(static_cast<Eigen::Index>(k), j));
  }
  return text + "\n";
}

/// Measured and fitted strains, and how sure they leave the parameters.
std::string strain_rows(const Plan& plan, const Fit& fit) {
  const RegionalFit& f = *fit.regional_fit;
  std::string text =
      fmt::format("\n  {:<18}{:>10}{:>10}{:>10}\n", "circumf. strain", "measured", "model", "off");
  for (std::size_t i = 0; i < f.strains.size(); ++i)
    text += fmt::format("  {:<18}{:>10.3f}{:>10.3f}{:>10.3f}\n", plan.strains[i].region,
                        plan.strains[i].value, f.strains[i], f.strains[i] - plan.strains[i].value);
  return text + fmt::format("  bias {:.3f}, rms {:.3f}; weight 1/{:g} of a strain\n", f.strain.bias,
                            f.strain.rms, plan.errors.strain);
}

/// How far the model's end-systolic surfaces are from the drawn ones.
std::string shape_rows(const Plan& plan, const ShapeFit& shape) {
  return fmt::format(
      "\n  end-systolic surfaces outside of the drawn ones, means of {} of {} parts: bias {:.2f} "
      "mm, rms {:.2f} mm (fitted to volumes alone: {:.2f}, {:.2f}); weight 1/({:g} mm)\n",
      counted_parts(shape.distances), plan.drawn.size(), shape.after.bias, shape.after.rms,
      shape.before.bias, shape.before.rms, plan.errors.shape);
}

std::string regional_rows(const Plan& plan, const Fit& fit) {
  const RegionalFit& f = *fit.regional_fit;
  return (f.strains.empty() ? "" : strain_rows(plan, fit)) +
         (f.shape ? shape_rows(plan, *f.shape) : "") +
         fmt::format(
             "  weight 1/{:g} of a volume's fraction; chi^2 {:.1f} for {:.1f} degrees of freedom\n",
             plan.errors.volume, f.chi_squared, f.degrees_of_freedom);
}

/// Of a segment's factor.
struct Interval {
  double low, high;
};

Interval interval(const FittedSegment& s) {
  constexpr double of_95_percent = 1.96;
  return {s.factor * std::exp(-of_95_percent * s.error),
          s.factor * std::exp(of_95_percent * s.error)};
}

/// Factors of segments, and how sure they are.
std::string segment_rows(const Plan& plan, const Fit& fit) {
  std::string text =
      fmt::format("\n  {:<22}{:>8}{:>16}{:>11}{:>12}   fitted from strain\n", "contractility of",
                  "factor", "95% interval", "+-(ln)", "resolution");
  double determined = 0.0;
  for (const FittedSegment& s : fit.segments) {
    const auto [low, high] = interval(s);
    text += fmt::format("  {:<22}{:>8.3f}{:>16}{:>11.3f}{:>12.2f}\n",
                        fmt::format("{} {}", s.segment, mesh::aha_name(s.segment)), s.factor,
                        fmt::format("{:.2f} to {:.2f}", low, high), s.error, s.resolution);
    determined += s.resolution;
  }
  return text + fmt::format(
                    "  the data determine {:.1f} of {} factors, the penalty (spread {:g} of the "
                    "logarithms) the rest\n",
                    determined, fit.segments.size(), plan.spread);
}

/// (J^T J)^-1 for the stated errors, larger when the model fits worse than they allow.
Eigen::MatrixXd covariance(const Fit& fit) {
  const RegionalFit& f = *fit.regional_fit;
  const double misfit = f.degrees_of_freedom > 0.0 ? f.chi_squared / f.degrees_of_freedom : 1.0;
  return std::max(1.0, misfit) * fit.sensitivity.covariance;
}

std::string deviation_rows(const Fit& fit) {
  const Eigen::MatrixXd C = covariance(fit);
  std::string text =
      fmt::format("\n  {:<12}{:>12}   covariance of the logarithms\n", "parameter", "deviation");
  for (Eigen::Index j = 0; j < C.rows(); ++j) {
    text += fmt::format("  {:<12}{:>11.1f}%  ", fit.sensitivity.parameters[j].name,
                        100.0 * std::sqrt(C(j, j)));
    for (Eigen::Index i = 0; i < C.cols(); ++i)
      text += fmt::format("{:>12.3g}", C(j, i));
    text += "\n";
  }
  return text;
}

/// What the data say least about: the direction of the parameters' logarithms with the largest
/// variance.
std::string weakest_direction(const Fit& fit) {
  const dense::Eigenpairs eigen = dense::symmetric_eigenpairs(covariance(fit));
  const Eigen::Index last = eigen.values.size() - 1;
  const Eigen::VectorXd v = eigen.vectors.col(last);
  std::string product;
  for (Eigen::Index j = 0; j < v.size(); ++j)
    product += fmt::format("{}{}^{:.2f}", j == 0 ? "" : " ", fit.sensitivity.parameters[j].name,
                           v[0] < 0.0 ? -v[j] : v[j]);
  const double deviation = std::sqrt(eigen.values[last]);
  return fmt::format("The data say least about {}: its standard deviation is {:.1f}%{}.", product,
                     100.0 * deviation, deviation > unknown ? ", so they leave it open" : "");
}

/// What the fit says of the Klotz curve, and what the end-diastolic pressure does to it.
std::string klotz_rows(const Plan& plan, const Fit& fit) {
  const Klotz k = klotz(plan.edv.volume, plan.ed_pressure);
  std::string text = fmt::format(
      "  Klotz's curve through {:.2f} ml at {:.2f} mmHg (assumed, not measured): V0 {:.2f} ml, V30 "
      "{:.2f} ml, P = {:.4g} (V/ml)^{:.3f} mmHg\n",
      1e-3 * plan.edv.volume, plan.ed_pressure / mmHg, 1e-3 * k.V0, 1e-3 * k.V30, k.alpha, k.beta);
  for (const OtherPressure& o : fit.other_pressures) {
    text += fmt::format("  had it been {:.2f} mmHg: ", o.pressure / mmHg);
    if (!o.parameters) {
      text += "no fit (" + o.why_not + ")\n";
      continue;
    }
    for (const Fitted& p : fit.sensitivity.parameters)
      text += fmt::format("{} {:.4g}, ", p.name, (*o.parameters).*p.member);
    text += fmt::format("unloaded {:.2f} ml\n", 1e-3 * o.unloaded_volume);
  }
  return text;
}

/// The interval that an assumed end-diastolic pressure leaves for every fitted value.
Json other_pressures_json(const Fit& fit) {
  Json rows = Json::array();
  for (const OtherPressure& o : fit.other_pressures) {
    Json row{{"pressure_mmHg", o.pressure / mmHg}};
    if (!o.parameters)
      row["no_fit"] = o.why_not;
    for (const Fitted& p : fit.sensitivity.parameters)
      row[p.name] = o.parameters ? Json((*o.parameters).*p.member) : Json();
    row["unloaded_volume_ml"] = o.parameters ? Json(1e-3 * o.unloaded_volume) : Json();
    rows.push_back(row);
  }
  return rows;
}

Json klotz_json(const Plan& plan, const Fit& fit) {
  const Klotz k = klotz(plan.edv.volume, plan.ed_pressure);
  return {{"seen_volume_ml", 1e-3 * plan.edv.volume},
          {"pressure_mmHg", plan.ed_pressure / mmHg},
          {"V0_ml", 1e-3 * k.V0},
          {"V30_ml", 1e-3 * k.V30},
          {"alpha_mmHg", k.alpha},
          {"beta", k.beta},
          {"model_V0_ml", 1e-3 * fit.unloaded_volume}};
}

/// In words, which parameters the data cannot tell apart.
std::vector<std::string> ambiguities(const Plan& plan, const Fit& fit) {
  std::vector<std::string> words;
  if (plan.passive == FittedPassive::C_a && !fit.regional_fit)
    words.emplace_back(
        "One volume determines one passive parameter: how a compares with a_f, a_s and a_fs, and "
        "the exponents, keep the case's values; other values with the same EDV fit as well.");
  if (plan.passive == FittedPassive::scale && !fit.regional_fit)
    words.emplace_back(
        "One volume determines one passive parameter: how a, a_f, a_s and a_fs compare, and the "
        "exponents, keep the case's values; other values with the same EDV fit as well.");
  if (plan.passive == FittedPassive::scale_and_exponent)
    words.emplace_back(
        "Scale and exponent are told apart by the Klotz curve alone, a mean over hearts and not a "
        "measurement of this one; how the a's compare, and how the b's, keep the case's values.");
  if (plan.passive == FittedPassive::klotz)
    words.emplace_back(
        "Scale and exponent follow from the end-diastolic shape, its pressure and the Klotz curve, "
        "a mean over hearts and not a measurement of this one; how the a's compare, and how the "
        "b's, keep the case's values.");
  const double e = fit.parameters.exponent;
  if (plan.fits_exponent() && (e < 1.001 * plan.exponent.low || e > 0.999 * plan.exponent.high))
    words.emplace_back("The exponent stands at the end of its range.");
  const Sensitivity& s = fit.sensitivity;
  for (Eigen::Index i = 0; i < s.correlation.rows(); ++i)
    for (Eigen::Index j = i + 1; j < s.correlation.cols(); ++j) {
      const double r = s.correlation(i, j);
      words.push_back(fmt::format(
          "{} and {}: errors of the measurements move them {} with correlation {:.2f}; {}.",
          s.parameters[i].name, s.parameters[j].name, r > 0.0 ? "together" : "against each other",
          r,
          std::abs(r) > alike ? "these data can hardly tell them apart"
                              : "these data tell them apart"));
    }
  if (fit.regional_fit)
    words.push_back(weakest_direction(fit));
  if (!fit.segments.empty())
    words.emplace_back(
        "Factors of contractility take up all that makes strain differ round the wall: thickness, "
        "fibres, the right ventricle and errors of tracking too. What a measurement that is off "
        "does to the other parameters is told with these factors held.");
  if (plan.active)
    words.emplace_back(
        "T_scale stands for every other cause of tension (calcium, its sensitivity, T_ref), which "
        "ESV cannot tell apart from it.");
  return words;
}

Json volume_json(const RecordedVolume& volume, const Fit& fit, std::size_t k) {
  Json json{{"name", volume.name},
            {"pressure_mmHg", volume.pressure / mmHg},
            {"target_ml", 1e-3 * volume.target},
            {"model_ml", 1e-3 * volume.model},
            {"dV_dp_ml_per_mmHg",
             1e-3 * mmHg * fit.sensitivity.by_pressure[static_cast<Eigen::Index>(k)]}};
  for (const Fitted& p : fit.sensitivity.parameters)
    json["dV_dparameter_ml"][p.name] = 1e-3 * volume.by_parameter.at(p.name);
  return json;
}

/// Of a region, by the logarithm of each fitted parameter.
Json slopes_json(const Fit& fit, const Eigen::MatrixXd& by_parameter, std::size_t region) {
  Json json;
  const auto& parameters = fit.sensitivity.parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    json[parameters[j].name] =
        by_parameter(static_cast<Eigen::Index>(region), static_cast<Eigen::Index>(j));
  return json;
}

Json strains_json(const Plan& plan, const Fit& fit) {
  const RegionalFit& f = *fit.regional_fit;
  Json json{{"error", plan.errors.strain}, {"bias", f.strain.bias}, {"rms", f.strain.rms}};
  for (std::size_t i = 0; i < f.strains.size(); ++i)
    json["regions"].push_back(
        {{"region", plan.strains[i].region},
         {"measured", plan.strains[i].value},
         {"model", f.strains[i]},
         {"d_dln_parameter", slopes_json(fit, fit.sensitivity.strain_by_parameter, i)}});
  return json;
}

Json shape_json(const Plan& plan, const Fit& fit) {
  const ShapeFit& shape = *fit.regional_fit->shape;
  const auto misfit = [](const Misfit& m) { return Json{{"bias_mm", m.bias}, {"rms_mm", m.rms}}; };
  Json json{{"error_mm", plan.errors.shape},
            {"fitted_to_volumes", misfit(shape.before)},
            {"fitted", misfit(shape.after)}};
  for (std::size_t i = 0; i < shape.distances.size(); ++i)
    if (shape.distances[i] != 0.0)
      json["parts"].push_back(
          {{"part", plan.drawn[i]},
           {"distance_mm", shape.distances[i]},
           {"d_dln_parameter_mm", slopes_json(fit, fit.sensitivity.distance_by_parameter, i)}});
  return json;
}

/// Of a fit to more than volumes.
Json least_squares_json(const Plan& plan, const Fit& fit) {
  const RegionalFit& f = *fit.regional_fit;
  Json json{{"error_of_volume", plan.errors.volume},
            {"chi_squared", f.chi_squared},
            {"degrees_of_freedom", f.degrees_of_freedom}};
  const Eigen::MatrixXd C = covariance(fit);
  for (Eigen::Index j = 0; j < C.rows(); ++j)
    json["covariance_of_logarithms"].push_back(
        std::vector<double>(C.row(j).begin(), C.row(j).end()));
  return json;
}

Json segment_json(const FittedSegment& s) {
  const auto [low, high] = interval(s);
  return {{"segment", s.segment},       {"name", mesh::aha_name(s.segment)},
          {"factor", s.factor},         {"standard_error_of_logarithm", s.error},
          {"interval_95", {low, high}}, {"resolution", s.resolution}};
}

Json uncertainty_json(const Plan& plan, const Fit& fit, std::size_t j) {
  const Fitted& which = fit.sensitivity.parameters[j];
  Json json{{"parameter", which.name}, {"value", fit.parameters.*which.member}};
  for (const int d : data_of(plan))
    json["when_off"].push_back({{"measurement", data_names[d]},
                                {"by", d < 2 ? "5%" : "2 mmHg"},
                                {"below", moved(fit, static_cast<int>(j), d, -1.0)},
                                {"above", moved(fit, static_cast<int>(j), d, 1.0)}});
  for (std::size_t i = 0; i < fit.sensitivity.parameters.size(); ++i)
    json["correlation"][fit.sensitivity.parameters[i].name] =
        fit.sensitivity.correlation(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i));
  return json;
}

}  // namespace

std::string text(const Plan& plan, const Fit& fit) {
  std::string text = "calibration with the quasi-static engine\n\n" + volume_rows(fit) +
                     (fit.regional_fit ? regional_rows(plan, fit) : "") +
                     (fit.segments.empty() ? "" : segment_rows(plan, fit)) +
                     parameter_rows(plan, fit) + (fit.regional_fit ? deviation_rows(fit) : "") +
                     derivative_rows(fit) + "\n";
  if (plan.passive == FittedPassive::scale_and_exponent) {
    const Klotz k = klotz(plan.edv.volume, plan.ed_pressure);
    text += fmt::format(
        "  Klotz's own estimate without pressure is {:.2f} ml; the model starts from {:.2f} ml.\n",
        1e-3 * k.V0, 1e-3 * fit.unloaded_volume);
  }
  if (plan.passive == FittedPassive::klotz)
    text += klotz_rows(plan, fit);
  for (const std::string& words : ambiguities(plan, fit))
    text += "  " + words + "\n";
  return text;
}

std::string json(const Plan& plan, const Fit& fit) {
  Json json;
  json["engine"] = "quasi-static";
  json["parameters"] = json_of(fit.parameters);
  json["tolerance"] = plan.tolerance;
  const RecordedFit record = recorded(plan, fit);
  for (std::size_t k = 0; k < record.volumes.size(); ++k)
    json["volumes"].push_back(volume_json(record.volumes[k], fit, k));
  for (std::size_t j = 0; j < fit.sensitivity.parameters.size(); ++j)
    json["uncertainty"].push_back(uncertainty_json(plan, fit, j));
  if (plan.passive == FittedPassive::klotz) {
    json["klotz"] = klotz_json(plan, fit);
    json["other_pressures"] = other_pressures_json(fit);
  }
  if (fit.regional_fit) {
    json["least_squares"] = least_squares_json(plan, fit);
    if (!plan.strains.empty())
      json["strains"] = strains_json(plan, fit);
    if (!plan.drawn.empty())
      json["shape"] = shape_json(plan, fit);
  }
  for (const FittedSegment& s : fit.segments)
    json["contractility"].push_back(segment_json(s));
  if (!fit.segments.empty())
    json["contractility_spread"] = plan.spread;
  json["uncertainty_by"] = "derivatives of the logarithms at the fit";
  json["ambiguities"] = ambiguities(plan, fit);
  json["evaluations"] = fit.history.size();
  return json.dump(2) + "\n";
}

Table contractility_table(const std::vector<FittedSegment>& segments) {
  Table table({"segment", "name", "factor", "standard_error_of_logarithm", "low_95", "high_95",
               "resolution"});
  for (const FittedSegment& s : segments) {
    const auto [low, high] = interval(s);
    table.add_row({std::to_string(s.segment), mesh::aha_name(s.segment), Table::number(s.factor),
                   Table::number(s.error), Table::number(low), Table::number(high),
                   Table::number(s.resolution)});
  }
  return table;
}

Table history_table(const Fit& fit) {
  Table table({"evaluation", "purpose", "C_a", "scale", "exponent", "T_scale", "pressure_mmHg",
               "activation", "volume_ml"});
  const auto number = [](double value) { return Table::number(value, 9); };
  int row = 0;
  for (const Evaluation& e : fit.history)
    table.add_row({std::to_string(++row), e.purpose, number(e.parameters.C_a),
                   number(e.parameters.scale), number(e.parameters.exponent),
                   number(e.parameters.T_scale), number(e.loads.pressure / mmHg),
                   number(e.loads.activation), number(1e-3 * e.volume)});
  return table;
}

}  // namespace lv::calibrate
