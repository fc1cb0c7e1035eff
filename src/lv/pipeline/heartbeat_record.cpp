#include "lv/pipeline/heartbeat_record.hpp"

#include "lv/base/check.hpp"
#include "lv/base/dense.hpp"
#include "lv/base/json_file.hpp"
#include "lv/case_file/beat_fit.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lv::pipeline {
namespace {

using Json = nlohmann::ordered_json;

constexpr double unknown_value = std::numeric_limits<double>::quiet_NaN();

/// Errors that measurements may well have: of a volume as a fraction, of a cuff's pressure in mmHg.
constexpr double volume_may_be_off = 0.05;
constexpr double cuff_may_be_off = 5.0;

/// By how much a datum may be off, in words and of its logarithm.
struct MayBeOff {
  std::string words;
  double by;
};
MayBeOff may_be_off(const FittedDatum& d) {
  return d.unit == "ml" ? MayBeOff{"5%", volume_may_be_off}
                        : MayBeOff{"5 mmHg", cuff_may_be_off / d.measured};
}

Json or_null(double value) {
  return std::isnan(value) ? Json() : Json(value);
}

std::string named(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

std::vector<std::size_t> measured_data(const HeartbeatFit& fit) {
  std::vector<std::size_t> measured;
  for (std::size_t k = 0; k < fit.data.size(); ++k)
    if (!std::isnan(fit.data[k].measured))
      measured.push_back(k);
  return measured;
}

std::string data_rows(const HeartbeatFit& fit) {
  std::string text =
      fmt::format("  {:<34}{:>12}{:>12}{:>10}\n", "last beat", "measured", "model", "off");
  for (const FittedDatum& d : fit.data) {
    const bool is_measured = !std::isnan(d.measured);
    text += fmt::format(
        "  {:<34}{:>12}{:>12.2f}{:>10}\n", named(d.name, d.unit),
        is_measured ? fmt::format("{:.2f}", d.measured) : "-", d.model,
        is_measured ? fmt::format("{:.2f}%", 100.0 * (d.model / d.measured - 1.0)) : "");
  }
  return text;
}

std::string parameter_rows(const HeartbeatFit& fit) {
  std::string text = fmt::format("\n  {:<34}{:>12}{:>12}  fitted to, name in a case file\n",
                                 "parameter", "before", "fitted");
  for (const FittedValue& p : fit.parameters)
    text += fmt::format("  {:<34}{:>12.4g}{:>12.4g}  {}, {}\n", named(p.words, p.unit), p.before,
                        p.fitted, p.datum, p.parameter);
  return text;
}

std::string sensitivity_rows(const HeartbeatFit& fit) {
  std::string text = fmt::format("\n  {:<22}", "d ln datum / d ln x");
  for (const FittedValue& p : fit.parameters)
    text += fmt::format("{:>22}", p.words);
  for (std::size_t k = 0; k < fit.data.size(); ++k) {
    text += fmt::format("\n  {:<22}", fit.data[k].name);
    for (std::size_t j = 0; j < fit.parameters.size(); ++j)
      text += fmt::format(
          "{:>22.3f}", fit.sensitivity(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)));
  }
  return text + "\n";
}

std::string moved_rows(const HeartbeatFit& fit) {
  std::string text = fmt::format("\n  {:<34}", "fitted, if off");
  for (const std::size_t k : measured_data(fit))
    text += fmt::format("{:>22}",
                        fmt::format("{} -+{}", fit.data[k].name, may_be_off(fit.data[k]).words));
  for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
    text += fmt::format("\n  {:<34}", named(fit.parameters[j].words, fit.parameters[j].unit));
    for (const std::size_t k : measured_data(fit)) {
      const double by = may_be_off(fit.data[k]).by;
      text += fmt::format(
          "{:>22}", fmt::format("{:.3g} / {:.3g}", fit.moved(j, k, -by), fit.moved(j, k, by)));
    }
  }
  return text + "\n";
}

Json data_json(const HeartbeatFit& fit) {
  Json rows = Json::array();
  for (std::size_t k = 0; k < fit.data.size(); ++k) {
    const FittedDatum& d = fit.data[k];
    Json row{{"name", d.name},
             {"unit", d.unit},
             {"measured", or_null(d.measured)},
             {"model", d.model},
             {"off", or_null(d.model / d.measured - 1.0)}};
    for (std::size_t j = 0; j < fit.parameters.size(); ++j)
      row["d_ln_datum_by_d_ln"][fit.parameters[j].parameter] =
          or_null(fit.sensitivity(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json parameter_json(const HeartbeatFit& fit, std::size_t j) {
  const FittedValue& p = fit.parameters[j];
  Json row{{"parameter", p.parameter}, {"words", p.words},   {"unit", p.unit},
           {"fitted_to", p.datum},     {"before", p.before}, {"value", p.fitted}};
  row["when_off"] = Json::array();
  for (const std::size_t k : measured_data(fit)) {
    const MayBeOff off = may_be_off(fit.data[k]);
    row["when_off"].push_back({{"measurement", fit.data[k].name},
                               {"by", off.words},
                               {"below", or_null(fit.moved(j, k, -off.by))},
                               {"above", or_null(fit.moved(j, k, off.by))}});
  }
  return row;
}

}  // namespace

double HeartbeatFit::moved(std::size_t parameter, std::size_t datum, double by) const {
  const std::vector<std::size_t> measured = measured_data(*this);
  Eigen::MatrixXd J(parameters.size(), parameters.size());
  Eigen::VectorXd change = Eigen::VectorXd::Zero(J.rows());
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    const std::size_t k = measured[static_cast<std::size_t>(i)];
    J.row(i) = sensitivity.row(static_cast<Eigen::Index>(k));
    if (k == datum)
      change[i] = by;
  }
  if (!J.allFinite())
    return unknown_value;
  return parameters[parameter].fitted *
         std::exp(dense::least_squares(J, change)(static_cast<Eigen::Index>(parameter), 0));
}

std::string text(const HeartbeatFit& fit) {
  std::string text = "calibration of heartbeats\n\n" + data_rows(fit) + parameter_rows(fit) +
                     sensitivity_rows(fit) + moved_rows(fit) + "\n";
  text +=
      "  A cuff's pressures are taken for the aorta's, in which the systolic one is lower by what "
      "the pulse gains on its way to the arm.\n";
  for (const std::string& sentence : fit.left_alone)
    text += fmt::format("  {}.\n", sentence);
  return text +
         fmt::format("  {} evaluations, {} heartbeats of the wall.\n", fit.evaluations, fit.beats);
}

std::string json(const HeartbeatFit& fit) {
  Json all{{"data", data_json(fit)}, {"parameters", Json::array()}};
  for (std::size_t j = 0; j < fit.parameters.size(); ++j)
    all["parameters"].push_back(parameter_json(fit, j));
  all["left_alone"] = fit.left_alone;
  all["tolerance"] = fit.tolerance;
  all["evaluations"] = fit.evaluations;
  all["beats"] = fit.beats;
  return all.dump(2) + "\n";
}

HeartbeatFit read_heartbeats(const std::filesystem::path& file) {
  return from_json_file(file, [&](const Json& all) {
    HeartbeatFit fit;
    for (const Json& d : all.at("data"))
      fit.data.push_back(
          {d.at("name"), d.at("unit"),
           d.at("measured").is_null() ? unknown_value : d.at("measured").get<double>(),
           d.at("model")});
    for (const Json& p : all.at("parameters")) {
      fit.parameters.push_back({p.at("parameter"), p.at("words"), p.at("unit"), p.at("fitted_to"),
                                p.at("before"), p.at("value")});
      if (case_file::find_parameter(fit.parameters.back().parameter) == nullptr)
        throw RunError(fmt::format("{} names a parameter that is none", file.string()),
                       "Delete its folder to make it again");
    }
    for (const Json& sentence : all.at("left_alone"))
      fit.left_alone.push_back(sentence.get<std::string>());
    fit.tolerance = all.at("tolerance");
    fit.evaluations = all.at("evaluations");
    fit.beats = all.at("beats");
    return fit;
  });
}

case_file::Case with_values(case_file::Case c, const HeartbeatFit& fit,
                            const std::filesystem::path& file) {
  for (const FittedValue& p : fit.parameters) {
    case_file::set_value(*case_file::find_parameter(p.parameter), c, p.fitted);
    c.origin[p.parameter] = file.string();
  }
  return c;
}

}  // namespace lv::pipeline
