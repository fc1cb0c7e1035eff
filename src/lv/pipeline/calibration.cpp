#include "lv/pipeline/calibration.hpp"

#include "lv/base/dense.hpp"
#include "lv/base/json_file.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/summary.hpp"
#include "lv/case_file/case_lines.hpp"
#include "lv/case_file/parameters.hpp"
#include "lv/cine/strain_targets.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/pipeline/answer_record.hpp"
#include "lv/pipeline/unloading.hpp"
#include "lv/solid/endocardial_surface.hpp"

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

/// Parameters by which a beat's volumes should come to the measured ones. The exponent follows the
/// Klotz curve; so does the scale of a shape of end-diastole, which fills to its own volume.
Json corrected(const Json& calibration, Json parameters, const Json& rows) {
  std::vector<std::string> names;
  for (const Json& u : calibration.at("uncertainty"))
    if (u.at("parameter") != "exponent" &&
        !(calibration.contains("klotz") && u.at("parameter") == "scale"))
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

/// The fit of a case on a mesh, with the wall without load for the fitted parameters. Collective.
struct FittedWall {
  calibrate::Fit fit;
  std::optional<implicit::Unloaded> unloaded;
};

FittedWall fit_wall(const Case& c, const anatomy::MeshResult& mesh,
                    const std::vector<cine::StrainTarget>& targets, const calibrate::Plan& task,
                    const FitParameters& start, const std::filesystem::path& answers) {
  calibrate::Ventricle ventricle(
      mesh.mesh, [&](const FitParameters& p) { return case_file::static_model(with(c, p)); },
      c.quasi_static.solver, c.unloaded);
  using solid::Loads;
  using Numbers = std::vector<double>;
  AnswerRecord record(ventricle, mesh.mesh.nodes.size(), answers);
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
  calibrate::Fit fit = calibrate::fit(model, start, task);
  ventricle.unloaded_volume(fit.parameters).value();
  return {std::move(fit), ventricle.unloaded()};
}

/// The same fit for another end-diastolic pressure under which the shape was seen. Stress and
/// pressure go together, so that it starts from a stiffness in proportion to the pressure.
calibrate::OtherPressure fit_at(double pressure, Case c, const anatomy::MeshResult& mesh,
                                calibrate::Plan task, FitParameters start,
                                const std::filesystem::path& answers) {
  log::info("the same with {:.2f} mmHg at end-diastole", pressure / units::mmHg);
  start.scale *= pressure / c.unloaded.pressure;
  c.unloaded.pressure = c.protocol.ed_pressure = task.ed_pressure = pressure;
  task.parameters_alone = true;
  task.strains.clear();
  try {
    const calibrate::Fit fit = fit_wall(c, mesh, {}, task, start, answers).fit;
    return {pressure, fit.parameters, fit.unloaded_volume, ""};
  } catch (const InputError& failure) {
    return {pressure, {}, 0.0, failure.what()};
  } catch (const RunError& failure) {
    return {pressure, {}, 0.0, failure.what()};
  }
}

/// Pressures that a case leaves to the defaults or to a rule of thumb.
std::vector<geometry::Assumption> assumed_pressures(const Case& c) {
  std::vector<geometry::Assumption> assumed;
  const auto left_out = [&](const char* parameter, const char* moment, double pressure) {
    if (!c.origin.contains(parameter))
      assumed.push_back(
          {fmt::format("{} pressure", moment), fmt::format("the default, {:g} mmHg; {} is not set",
                                                           pressure / units::mmHg, parameter)});
  };
  left_out("protocol.ed_pressure", "end-diastolic", c.protocol.ed_pressure);
  if (c.cuff_systolic > 0.0)
    assumed.push_back({"end-systolic pressure",
                       fmt::format("{:.1f} mmHg, {:g} of the cuff's {:g} mmHg (Kelly et al. 1992)",
                                   c.protocol.es_pressure / units::mmHg, case_file::systolic_share,
                                   c.cuff_systolic / units::mmHg)});
  else
    left_out("protocol.es_pressure", "end-systolic", c.protocol.es_pressure);
  return assumed;
}

/// Volumes of Klotz's curve beside the model's, and what the end-diastolic pressure costs.
void add_klotz(const Json& calibration, FitRecord& record) {
  for (const Json& v : calibration.at("volumes"))
    if (v.at("name").get<std::string>().starts_with("Klotz"))
      record.klotz.push_back({v.at("name"), v.at("pressure_mmHg").get<double>() * units::mmHg,
                              1e3 * v.at("target_ml").get<double>(),
                              1e3 * v.at("model_ml").get<double>()});
  std::string text = fmt::format("{:g} mmHg is taken for this person's",
                                 calibration.at("klotz").at("pressure_mmHg").get<double>());
  for (const Json& other : calibration.at("other_pressures")) {
    text += fmt::format("; with {:g} mmHg", other.at("pressure_mmHg").get<double>());
    if (other.contains("no_fit")) {
      text += " there is no fit";
      continue;
    }
    for (const Json& u : calibration.at("uncertainty")) {
      const std::string name = u.at("parameter");
      text += fmt::format(" {} {:.3g}", name, other.at(name).get<double>());
    }
    text += fmt::format(", unloaded {:.1f} ml", other.at("unloaded_volume_ml").get<double>());
  }
  record.assumed.push_back({"filling pressure and Klotz's curve", text});
}

}  // namespace

std::vector<std::string> fitted_names(const case_file::Calibration& k) {
  std::vector<std::string> names;
  if (k.passive == FittedPassive::C_a)
    names.emplace_back("passive.C_a");
  const bool exponent =
      k.passive == FittedPassive::scale_and_exponent || k.passive == FittedPassive::klotz;
  if (k.passive == FittedPassive::scale || exponent)
    for (const char* a : {"a", "a_f", "a_s", "a_fs"})
      names.push_back(std::string("passive.holzapfel_ogden.") + a);
  if (exponent)
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
  const std::vector<cine::StrainTarget> targets = cine::strain_targets(c, mesh.regions);
  calibrate::Plan task = plan(c, targets);
  const bool klotz = task.passive == FittedPassive::klotz;
  if (klotz)
    task.edv = {solid::EndocardialSurface(mesh.mesh).volume(mesh.mesh.nodes),
                case_file::place_of(c, "unloaded.pressure")};
  auto [fit, unloaded] =
      fit_wall(c, mesh, targets, task, {.C_a = c.passive.C_a, .T_scale = c.active.T_scale},
               folder / answers_name);
  std::vector<std::filesystem::path> records{folder / answers_name};
  const double error = c.calibration.pressure_error;
  if (klotz && error > 0.0)
    for (const double pressure : {task.ed_pressure - error, task.ed_pressure + error}) {
      records.push_back(folder / fmt::format("answers_{}.bin", records.size()));
      fit.other_pressures.push_back(
          fit_at(pressure, c, mesh, task, fit.parameters, records.back()));
    }
  if (!parallel::is_root())
    return;
  if (unloaded)
    write_unloaded(*unloaded, folder / unloaded_shape_name);
  for (const std::filesystem::path& record : records)
    std::filesystem::remove(record);
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

FitRecord fit_record(const Case& c, const std::filesystem::path& calibration,
                     const std::filesystem::path& beat) {
  FitRecord all;
  all.assumed = assumed_pressures(c);
  if (!c.calibration.asked())
    return all;
  all.volumes = from_json_file(beat / confirmation_name, [&](const Json& record) {
    std::vector<report::FittedVolume> volumes;
    for (const Json& row : record.at("beats").back().at("volumes"))
      volumes.push_back({row.at("name"), 1e3 * row.at("measured_ml").get<double>(),
                         1e3 * row.at("quasi_static_ml").get<double>(),
                         1e3 * row.at("beat_ml").get<double>(),
                         std::abs(row.at("off").get<double>()) <= c.calibration.tolerance});
    return volumes;
  });
  if (c.calibration.passive == FittedPassive::klotz)
    add_klotz(from_json_file(calibration / calibration_name, [](const Json& json) { return json; }),
              all);
  return all;
}

}  // namespace lv::pipeline
