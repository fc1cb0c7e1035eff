#include "lv/pipeline/calibration.hpp"

#include "lv/base/dense.hpp"
#include "lv/base/json_file.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/calibrate/summary.hpp"
#include "lv/case_file/case_lines.hpp"
#include "lv/case_file/parameters.hpp"
#include "lv/cine/strain_targets.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/pipeline/answer_record.hpp"
#include "lv/pipeline/unloading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lv::pipeline {
namespace {

using calibrate::FitParameters;
using calibrate::FittedPassive;
using case_file::Case;
using Json = nlohmann::ordered_json;

constexpr const char* answers_name = "answers.bin";
constexpr std::size_t most_beats = 3;  // one, and two with corrected parameters

/// The case with other parameters; scale and exponent are factors of the case's.
Case with(Case c, const FitParameters& p) {
  c.passive.C_a = p.C_a;
  c.passive.holzapfel_ogden = c.passive.holzapfel_ogden.scaled(p.scale, p.exponent);
  c.active.T_scale = p.T_scale;
  return c;
}

calibrate::Plan plan(const Case& c, const std::vector<cine::StrainTarget>& targets) {
  const case_file::Calibration& k = c.calibration;
  std::vector<calibrate::MeasuredStrain> strains;
  for (const cine::StrainTarget& target : targets)
    strains.push_back(target.measured);
  return {k.passive,
          k.active,
          c.protocol.ed_pressure,
          c.protocol.es_pressure,
          {k.edv, case_file::place_of(c, "calibrate.edv")},
          {k.esv, case_file::place_of(c, "calibrate.esv")},
          k.tolerance,
          k.stiffness,
          k.exponent,
          k.T_scale,
          strains,
          k.errors};
}

/// Lines for a case file, in place of its [calibrate].
std::string fragment(const Case& fitted) {
  std::vector<case_file::CaseLine> lines;
  const auto names = fitted_names(fitted.calibration);
  for (const case_file::Parameter& p : case_file::parameters())
    if (std::find(names.begin(), names.end(), p.name) != names.end())
      lines.push_back({p.name, p.get(fitted), ""});
  return "# Fitted parameters, to be set in a case file instead of [calibrate]\n\n" +
         case_file::case_lines(lines);
}

Json volumes_json(const Json& calibration, const heartbeat::Beat& beat) {
  Json rows = Json::array();
  for (const Json& v : calibration.at("volumes")) {
    const std::string name = v.at("name");
    if (name != "EDV" && name != "ESV")
      continue;
    const double volume = 1e-3 * (name == "EDV" ? beat.at(heartbeat::end_diastole).volume
                                                : beat.at(heartbeat::end_systole).volume);
    rows.push_back({{"name", name},
                    {"measured_ml", v.at("target_ml")},
                    {"quasi_static_ml", v.at("model_ml")},
                    {"beat_ml", volume},
                    {"off", volume / v.at("target_ml").get<double>() - 1.0}});
  }
  return rows;
}

/// Parameters by which a beat's volumes should come to the measured ones.
Json corrected(const Json& calibration, Json parameters, const Json& rows) {
  std::vector<std::string> names;
  for (const Json& u : calibration.at("uncertainty"))
    if (u.at("parameter") != "exponent")
      names.push_back(u.at("parameter"));
  const auto n = static_cast<Eigen::Index>(names.size());
  Eigen::MatrixXd J(n, n);
  Eigen::VectorXd missing(n);
  Eigen::Index k = 0;
  for (const Json& v : calibration.at("volumes")) {
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const Json& r) { return r.at("name") == v.at("name"); });
    if (row == rows.end())
      continue;
    missing[k] = row->at("measured_ml").get<double>() - row->at("beat_ml").get<double>();
    for (Eigen::Index j = 0; j < n; ++j)
      J(k, j) = v.at("dV_dparameter_ml").at(names[j]).get<double>() *
                calibration.at("parameters").at(names[j]).get<double>();
    ++k;
  }
  const Eigen::VectorXd change = dense::solve(J, missing);
  for (Eigen::Index j = 0; j < n; ++j)
    parameters[names[j]] = parameters.at(names[j]).get<double>() * std::exp(change[j]);
  return parameters;
}

}  // namespace

std::vector<std::string> fitted_names(const case_file::Calibration& k) {
  std::vector<std::string> names;
  if (k.passive == FittedPassive::C_a)
    names.emplace_back("passive.C_a");
  if (k.passive == FittedPassive::scale || k.passive == FittedPassive::scale_and_exponent)
    for (const char* a : {"a", "a_f", "a_s", "a_fs"})
      names.push_back(std::string("passive.holzapfel_ogden.") + a);
  if (k.passive == FittedPassive::scale_and_exponent)
    for (const char* b : {"b", "b_f", "b_s", "b_fs"})
      names.push_back(std::string("passive.holzapfel_ogden.") + b);
  if (k.active)
    names.emplace_back("active.T_scale");
  return names;
}

Case for_calibration(Case c) {
  c.engine = case_file::Engine::quasi_static;
  return c;
}

void make_calibration(const Case& c, const anatomy::MeshResult& mesh,
                      const std::filesystem::path& folder) {
  calibrate::Ventricle ventricle(
      mesh.mesh, [&](const FitParameters& p) { return case_file::static_model(with(c, p)); },
      c.quasi_static.solver, c.unloaded);
  const std::vector<cine::StrainTarget> targets = cine::strain_targets(c, mesh.regions);
  using solid::Loads;
  using Numbers = std::vector<double>;
  AnswerRecord record(ventricle, mesh.mesh.nodes.size(), folder / answers_name);
  const auto number = [&](const std::function<Outcome<double>()>& ask) -> Outcome<double> {
    const auto answer = record.answer([&]() -> Outcome<Numbers> {
      const auto found = ask();
      return found ? Outcome<Numbers>(Numbers{*found}) : found.why();
    });
    return answer ? Outcome<double>(answer->front()) : answer.why();
  };
  const auto strains = [&](const FitParameters& p, const Loads& ed,
                           const Loads& es) -> Outcome<Numbers> {
    const auto end_diastole = ventricle.positions(p, ed);
    if (!end_diastole)
      return end_diastole.why();
    const auto end_systole = ventricle.positions(p, es);
    if (!end_systole)
      return end_systole.why();
    return cine::regional_strains(c, ventricle.wall(), targets, *end_diastole, *end_systole);
  };
  const calibrate::Model model{
      [&](const FitParameters& p, const Loads& loads) {
        return number([&] { return ventricle.volume(p, loads); });
      },
      [&](const FitParameters& p) { return number([&] { return ventricle.unloaded_volume(p); }); },
      [&](const FitParameters& p, const Loads& ed, const Loads& es) {
        return record.answer([&] { return strains(p, ed, es); });
      }};
  const calibrate::Plan task = plan(c, targets);
  const calibrate::Fit fit =
      calibrate::fit(model, {.C_a = c.passive.C_a, .T_scale = c.active.T_scale}, task);
  ventricle.unloaded_volume(fit.parameters).value();
  const auto& unloaded = ventricle.unloaded();
  if (!parallel::is_root())
    return;
  if (unloaded)
    write_unloaded(*unloaded, folder / unloaded_shape_name);
  std::filesystem::remove(folder / answers_name);
  calibrate::history_table(fit).write_csv(folder / "calibration.csv");
  write_file(folder / "calibration.txt", calibrate::text(task, fit));
  write_file(folder / "calibrated.toml", fragment(with(c, fit.parameters)));
  write_file(folder / calibration_name, calibrate::json(task, fit));
}

Case calibrated(Case c, const std::filesystem::path& file) {
  for (const std::string& name : fitted_names(c.calibration))
    c.origin[name] = file.string();
  return with(std::move(c), calibrate::parameters_of(file));
}

bool correct(const Case& c, const std::filesystem::path& calibration_folder,
             const heartbeat::Beat& beat, const std::filesystem::path& folder) {
  const auto whole = [](const Json& json) { return json; };
  const Json calibration = from_json_file(calibration_folder / calibration_name, whole);
  const auto file = folder / confirmation_name;
  Json record{{"parameters", calibration.at("parameters")}, {"beats", Json::array()}};
  if (std::filesystem::exists(file))
    record = from_json_file(file, whole);
  Json& beats = record["beats"];
  if (!beats.empty() && beats.back().at("parameters") == record.at("parameters"))
    beats.erase(beats.size() - 1);  // this very beat, recorded before the run was stopped
  const Json rows = volumes_json(calibration, beat);
  const bool within = std::all_of(rows.begin(), rows.end(), [&](const Json& row) {
    return std::abs(row.at("off").get<double>()) <= c.calibration.tolerance;
  });
  beats.push_back(
      {{"parameters", record.at("parameters")}, {"volumes", rows}, {"within_tolerance", within}});
  record["tolerance"] = c.calibration.tolerance;
  const bool again = !within && c.calibration.confirm && beats.size() < most_beats;
  if (again) {
    record["parameters"] = corrected(calibration, record.at("parameters"), rows);
    log::info("the beat's volumes are off by more than {:g}%; once more with {}",
              100.0 * c.calibration.tolerance, record["parameters"].dump());
    std::filesystem::remove(folder / heartbeat::checkpoint_name);  // before the new parameters
  }
  write_file(file, record.dump(2) + "\n");
  if (!again)
    write_file(folder / "calibrated.toml", fragment(calibrated(c, file)));
  return again;
}

std::vector<report::FittedVolume> fitted_volumes(const Case& c, const std::filesystem::path& beat) {
  std::vector<report::FittedVolume> volumes;
  if (!c.calibration.asked())
    return volumes;
  return from_json_file(beat / confirmation_name, [&](const Json& record) {
    for (const Json& row : record.at("beats").back().at("volumes"))
      volumes.push_back({row.at("name"), 1e3 * row.at("measured_ml").get<double>(),
                         1e3 * row.at("quasi_static_ml").get<double>(),
                         1e3 * row.at("beat_ml").get<double>(),
                         std::abs(row.at("off").get<double>()) <= c.calibration.tolerance});
    return volumes;
  });
}

}  // namespace lv::pipeline
