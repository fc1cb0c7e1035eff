#include "lv/beating_wall/heartbeat_record.hpp"

#include "lv/base/dense.hpp"
#include "lv/base/json_file.hpp"
#include "lv/case_file/beat_fit.hpp"
#include "lv/heartbeat/archive.hpp"

#include <fmt/format.h>

#include <cmath>

namespace lv::beating_wall {
namespace {

using Json = nlohmann::ordered_json;
using heartbeat::Archive;

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

void store_data(const HeartbeatFit& fit, Archive& archive) {
  std::vector<std::string> names;
  std::vector<std::string> data_units;
  std::vector<double> values;
  for (const FittedDatum& d : fit.data) {
    names.push_back(d.name);
    data_units.push_back(d.unit);
    values.insert(values.end(), {d.measured, d.model});
  }
  archive.set_words("data.names", names);
  archive.set_words("data.units", data_units);
  archive.set("data", std::move(values));
}

void load_data(const Archive& archive, HeartbeatFit& fit) {
  const auto names = archive.get_words("data.names");
  const auto data_units = archive.get_words("data.units");
  const auto& values = archive.get_rows("data", 2, names.size(), {.missing = true});
  if (data_units.size() != names.size())
    archive.refuse("it has not a unit for every datum");
  for (std::size_t k = 0; k < names.size(); ++k)
    fit.data.push_back({names[k], data_units[k], values[2 * k], values[2 * k + 1]});
}

/// Four words of each: its name, the same for readers, its unit, and the datum it is fitted to.
constexpr std::size_t words_of_parameter = 4;

void store_parameters(const HeartbeatFit& fit, Archive& archive) {
  std::vector<std::string> words;
  std::vector<double> values;
  for (const FittedValue& p : fit.parameters) {
    words.insert(words.end(), {p.parameter, p.words, p.unit, p.datum});
    values.insert(values.end(), {p.before, p.fitted});
  }
  archive.set_words("parameters.words", words);
  archive.set("parameters", std::move(values));
}

void load_parameters_of(const Archive& archive, HeartbeatFit& fit) {
  const auto words = archive.get_words("parameters.words");
  const auto& values = archive.get_rows("parameters", 2, words.size() / words_of_parameter);
  for (std::size_t j = 0; 2 * j < values.size(); ++j) {
    const std::string* of = &words[words_of_parameter * j];
    if (case_file::find_parameter(of[0]) == nullptr)
      archive.refuse(fmt::format("'{}' is no parameter", of[0]));
    fit.parameters.push_back({of[0], of[1], of[2], of[3], values[2 * j], values[2 * j + 1]});
  }
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

void write_heartbeats(const HeartbeatFit& fit, const std::filesystem::path& file) {
  Archive archive;
  store_data(fit, archive);
  store_parameters(fit, archive);
  std::vector<double> sensitivity;
  for (Eigen::Index k = 0; k < fit.sensitivity.rows(); ++k)
    sensitivity.insert(sensitivity.end(), fit.sensitivity.row(k).begin(),
                       fit.sensitivity.row(k).end());
  archive.set("sensitivity", std::move(sensitivity));
  archive.set_words("left_alone", fit.left_alone);
  archive.set("tolerance", {fit.tolerance});
  archive.set("counts", {static_cast<double>(fit.evaluations), static_cast<double>(fit.beats)});
  archive.write(file);
}

HeartbeatFit read_heartbeats(const std::filesystem::path& file) {
  const Archive archive = Archive::read(file);
  HeartbeatFit fit;
  load_data(archive, fit);
  load_parameters_of(archive, fit);
  const std::size_t columns = fit.parameters.size();
  const auto& sensitivity =
      archive.get_rows("sensitivity", 1, fit.data.size() * columns, {.missing = true});
  fit.sensitivity.resize(static_cast<Eigen::Index>(fit.data.size()),
                         static_cast<Eigen::Index>(columns));
  for (std::size_t n = 0; n < sensitivity.size(); ++n)
    fit.sensitivity(static_cast<Eigen::Index>(n / columns),
                    static_cast<Eigen::Index>(n % columns)) = sensitivity[n];
  fit.left_alone = archive.get_words("left_alone");
  fit.tolerance = archive.number("tolerance");
  const auto counts = archive.get_whole("counts", 2, heartbeat::not_negative);
  fit.evaluations = counts[0];
  fit.beats = counts[1];
  return fit;
}

case_file::Case with_values(case_file::Case c, const HeartbeatFit& fit,
                            const std::filesystem::path& file) {
  for (const FittedValue& p : fit.parameters) {
    case_file::set_value(*case_file::find_parameter(p.parameter), c, p.fitted);
    c.origin[p.parameter] = file.string();
  }
  return c;
}

}  // namespace lv::beating_wall
