#include "lv/pipeline/calibration.hpp"

#include "lv/anatomy/shape_distance.hpp"
#include "lv/base/dense.hpp"
#include "lv/base/log.hpp"
#include "lv/base/parallel.hpp"
#include "lv/base/table.hpp"
#include "lv/base/units.hpp"
#include "lv/beating_wall/heartbeat_fit.hpp"
#include "lv/calibrate/fit_out_of_reach.hpp"
#include "lv/calibrate/fit_parts.hpp"
#include "lv/calibrate/record.hpp"
#include "lv/calibrate/summary.hpp"
#include "lv/case_file/case_lines.hpp"
#include "lv/case_file/parameters.hpp"
#include "lv/cine/strain_targets.hpp"
#include "lv/heartbeat/immersed_beat.hpp"
#include "lv/pipeline/answer_record.hpp"
#include "lv/pipeline/confirmation.hpp"
#include "lv/pipeline/fit_archive.hpp"
#include "lv/pipeline/unloading.hpp"
#include "lv/solid/endocardial_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace lv::pipeline {
namespace {

using beating_wall::HeartbeatFit;
using beating_wall::heartbeats_json;
using beating_wall::heartbeats_name;
using beating_wall::read_heartbeats;
using calibrate::FitParameters;
using calibrate::FittedPassive;
using case_file::Case;

constexpr const char* answers_name = "answers.bin";
constexpr const char* coarse_answers_name = "answers_coarse.bin";
constexpr const char* muscle_text = "muscle.txt";
constexpr const char* stress_free_name = "stress_free.bin";
constexpr double coarse_edge = 13.0;         // [mm]
constexpr double shortest_of_coarse = 10.0;  // edges that are not made coarser [mm]
constexpr std::size_t most_beats = 3;        // one, and two with corrected parameters

/// The case with other parameters; scale and exponent are factors of the case's.
Case with(Case c, const FitParameters& p) {
  c.passive.C_a = p.C_a;
  c.passive.holzapfel_ogden = c.passive.holzapfel_ogden.scaled(p.scale, p.exponent);
  c.active.T_scale = p.T_scale;
  if (c.calibration.contractility == case_file::FittedContractility::segments)
    c.fitted_contractility = p.segments;
  return c;
}

/// The AHA segments that strains say something of.
std::vector<int> segments_of(const std::vector<strain::RegionStrain>& targets,
                             const mesh::Regions& regions) {
  std::set<int> segments;
  for (const strain::RegionStrain& target : targets)
    for (const int cell : target.cells)
      segments.insert(regions.aha[cell]);
  return {segments.begin(), segments.end()};
}

/// What is fitted to besides volumes.
struct Targets {
  std::vector<strain::RegionStrain> strains;
  std::vector<anatomy::DrawnPart> drawn;
};

Targets targets_of(const Case& c, const anatomy::MeshResult& mesh,
                   const std::filesystem::path& folder) {
  Targets targets{cine::strain_targets(c, mesh.regions), {}};
  if (c.calibration.shape) {
    const anatomy::AnatomyRecord anatomy = anatomy_beside(folder);
    targets.drawn =
        anatomy::drawn_parts(anatomy.frame.value(), anatomy.end_systole, c.regions.septum_angle);
  }
  return targets;
}

calibrate::Plan plan(const Case& c, const Targets& targets, const mesh::Regions& regions) {
  const case_file::Calibration& k = c.calibration;
  std::vector<calibrate::MeasuredStrain> strains;
  for (const strain::RegionStrain& target : targets.strains)
    strains.push_back({target.region, target.strain});
  std::vector<std::string> drawn;
  for (const anatomy::DrawnPart& part : targets.drawn)
    drawn.push_back(part.name);
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
          k.errors,
          k.contractility == case_file::FittedContractility::segments
              ? segments_of(targets.strains, regions)
              : std::vector<int>{},
          k.contractility_spread,
          drawn};
}

/// Names of the parameters that are fitted at given pressures.
std::vector<std::string> muscle_names(const case_file::Calibration& k) {
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
  if (k.contractility == case_file::FittedContractility::segments)
    names.emplace_back("muscle.contractility");
  return names;
}

calibrate::RecordedFit read_fit(const std::filesystem::path& calibration) {
  return load_fit(heartbeat::Archive::read(calibration / calibration_name));
}

/// The case with what is fitted to its heartbeats.
Case with_beats(Case c, const std::filesystem::path& calibration) {
  if (!c.calibration.cycle)
    return c;
  return with_values(std::move(c), read_heartbeats(calibration / heartbeats_name),
                     calibration / heartbeats_json);
}

/// Lines for a case file, in place of its [calibrate].
std::string fragment(const Case& fitted, const std::vector<std::string>& names) {
  std::vector<case_file::CaseLine> lines;
  for (const case_file::Parameter& p : case_file::parameters())
    if (std::find(names.begin(), names.end(), p.name) != names.end())
      lines.push_back({p.name, p.get(fitted), ""});
  return "# Fitted parameters, to be set in a case file instead of [calibrate]\n\n" +
         case_file::case_lines(lines);
}

std::vector<ConfirmedVolume> volumes_of(const calibrate::RecordedFit& fit,
                                        const heartbeat::Beat& beat) {
  std::vector<ConfirmedVolume> volumes;
  for (const calibrate::RecordedVolume& v : fit.volumes)
    for (const heartbeat::MomentWords& at : heartbeat::moment_words)
      if (v.name == at.volume)
        volumes.push_back({v.name, v.target, v.model, beat.at(at.moment).volume});
  return volumes;
}

/// Parameters by which a beat's volumes should come to the measured ones. The exponent follows the
/// Klotz curve; so does the scale of a shape of end-diastole, which fills to its own volume.
FitParameters corrected(const calibrate::RecordedFit& fit, FitParameters parameters,
                        const std::vector<ConfirmedVolume>& found) {
  std::vector<calibrate::Fitted> free;
  for (const calibrate::Fitted& p : fit.fitted)
    if (p.name != "exponent" && !(fit.klotz_pressure && p.name == "scale"))
      free.push_back(p);
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd J(n, n);
  Eigen::VectorXd missing(n);
  Eigen::Index k = 0;
  for (const calibrate::RecordedVolume& v : fit.volumes) {
    const auto row = std::find_if(found.begin(), found.end(),
                                  [&](const ConfirmedVolume& r) { return r.name == v.name; });
    if (row == found.end())
      continue;
    missing[k] = row->measured - row->beat;
    for (Eigen::Index j = 0; j < n; ++j)
      J(k, j) = v.by_parameter.at(free[j].name) * fit.parameters.*free[j].member;
    ++k;
  }
  const Eigen::VectorXd change = dense::solve(J, missing);
  for (Eigen::Index j = 0; j < n; ++j)
    parameters.*free[j].member *= std::exp(change[j]);
  return parameters;
}

/// Where a fit begins.
struct FitStart {
  FitParameters parameters;
  std::vector<Vec3> unloaded = {};             ///< nodes near those without load; may be empty [mm]
  std::optional<Eigen::MatrixXd> slopes = {};  ///< calibrate::Plan::slopes
};

/// How far a fit is, and what was answered so far.
struct FitLog {
  calibrate::FitForecast& forecast;
  std::filesystem::path answers;
};

/// The fit of a case on a mesh, with the wall without load for the fitted parameters. Collective.
struct FittedWall {
  calibrate::Fit fit;
  std::optional<implicit::Unloaded> unloaded;
};

FittedWall fit_wall(const Case& c, const anatomy::MeshResult& mesh, const Targets& targets,
                    const calibrate::Plan& task, const FitStart& start, const FitLog& kept) {
  calibrate::Ventricle ventricle(
      mesh.mesh, [&](const FitParameters& p) { return case_file::static_model(with(c, p)); },
      c.quasi_static.solver, c.unloaded);
  if (!start.unloaded.empty())
    ventricle.begin_near(start.unloaded);
  using solid::Loads;
  using Numbers = std::vector<double>;
  AnswerRecord record(ventricle, mesh.mesh.nodes.size(), kept.answers);
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
    return cine::regional_strains(c, ventricle.wall(), targets.strains, *end_diastole,
                                  *end_systole);
  };
  const auto distances = [&](const FitParameters& p, const Loads& es) -> Outcome<Numbers> {
    const auto end_systole = ventricle.positions(p, es);
    if (!end_systole)
      return end_systole.why();
    Numbers found(targets.drawn.size());
    parallel::on_root(
        [&] { found = anatomy::mean_distances(mesh.mesh, *end_systole, targets.drawn); });
    parallel::broadcast(found);
    return found;
  };
  const calibrate::Model model{
      [&](const FitParameters& p, const Loads& loads) {
        return number([&] { return ventricle.volume(p, loads); });
      },
      [&](const FitParameters& p) { return number([&] { return ventricle.unloaded_volume(p); }); },
      [&](const FitParameters& p, const Loads& ed, const Loads& es) {
        return record.answer([&] { return strains(p, ed, es); });
      },
      [&](const FitParameters& p, const Loads& es) {
        return record.answer([&] { return distances(p, es); });
      },
      [&](const std::optional<FitParameters>& about) { ventricle.linearise(about, task.segments); },
      [&] { return ventricle.folded_volume(); },
      [&](const FitParameters& p, double volume) {
        return number([&] { return ventricle.share_that_leaves(p, volume); });
      },
      [&] { return ventricle.work(); },
      [&](const calibrate::OnTheWay& told) { ventricle.tell(told); }};
  calibrate::Fit fit = calibrate::fit(model, start.parameters, task, kept.forecast);
  ventricle.unloaded_volume(fit.parameters).value();
  return {std::move(fit), ventricle.unloaded()};
}

/// Of the parameters alone.
calibrate::Plan alone(calibrate::Plan task) {
  task.parameters_alone = true;
  task.strains.clear();
  task.segments.clear();
  task.drawn.clear();
  return task;
}

/// Where a fit begins that is near one that was found.
FitStart start_at(const FittedWall& found) {
  FitStart start{found.fit.parameters, {}, found.fit.slopes};
  if (found.unloaded && found.unloaded->smoothing == 0.0)
    start.unloaded = found.unloaded->nodes;
  return start;
}

/// The same fit for another end-diastolic pressure under which the shape was seen. Stress and
/// pressure go together, so that it starts from a stiffness in proportion to the pressure, with
/// which the wall without load is nearly the same.
calibrate::OtherPressure fit_at(double pressure, Case c, const anatomy::MeshResult& mesh,
                                calibrate::Plan task, FitStart start, const FitLog& kept) {
  log::info("the same with {:.2f} mmHg at end-diastole", pressure / units::mmHg);
  start.parameters.scale *= pressure / c.unloaded.pressure;
  c.unloaded.pressure = c.protocol.ed_pressure = task.ed_pressure = pressure;
  task.starts_near = true;
  try {
    const calibrate::Fit fit = fit_wall(c, mesh, {}, alone(task), start, kept).fit;
    return {pressure, fit.parameters, fit.unloaded_volume, ""};
  } catch (const InputError& failure) {
    return {pressure, {}, 0.0, failure.what()};
  } catch (const NoSolution& failure) {
    return {pressure, {}, 0.0, failure.what()};
  }
}

/// Of the shape that fills to its own volume under its pressure.
void set_seen_volume(const Case& c, const anatomy::MeshResult& mesh, calibrate::Plan& task) {
  if (task.passive == FittedPassive::klotz)
    task.edv = {solid::EndocardialSurface(mesh.mesh).volume(mesh.mesh.nodes),
                case_file::place_of(c, "unloaded.pressure")};
}

/// Where the fit on a mesh begins: at the end of the one on a coarse wall, or where that misses a
/// volume by no more than walls differ, so that the other finds out at once whether it does.
/// Nothing where that wall has no fit, which says nothing of the other. Throws OutOfReach where it
/// misses a volume by more. What it misses is said at once: the other wall may take minutes for it.
std::optional<FitStart> fit_coarse(const Case& c, const anatomy::MeshResult& coarse,
                                   const anatomy::MeshResult& mesh, calibrate::Plan task,
                                   const FitParameters& start, const FitLog& kept) {
  const int elements = coarse.mesh.cell_count() / 8;
  log::info("the fit is made on a coarse wall first, of {} elements", elements);
  const auto warn = [&](const std::exception& failure) {
    log::warn("on a coarse wall of {} elements: {}", elements, failure.what());
  };
  set_seen_volume(c, coarse, task);
  try {
    FitStart first = start_at(fit_wall(c, coarse, {}, alone(task), {start}, kept));
    if (!first.unloaded.empty())
      first.unloaded = carried(coarse.mesh, first.unloaded, mesh.mesh);
    return first;
  } catch (const calibrate::FitOutOfReach& failure) {
    if (failure.missing() > calibrate::reach_margin)
      throw failure.found(fmt::format(" (on a coarse wall of {} elements)", elements));
    warn(failure);
    if (failure.missing() > 0.0) {
      log::info("a finer wall may reach it: the fit goes on there from what came nearest");
      return FitStart{failure.parameters()};
    }
  } catch (const InputError& failure) {
    warn(failure);
  } catch (const NoSolution& failure) {
    warn(failure);
  }
  log::info("a finer wall may have a fit all the same: it begins anew there");
  return {};
}

/// Pressures that a case leaves to the defaults or to a rule of thumb. In a heartbeat the
/// circulation makes them; a fit before it still reads them.
std::vector<geometry::Assumption> assumed_pressures(const Case& c) {
  if (case_file::is_cycle(c) && !c.calibration.fits_muscle())
    return {};
  std::vector<geometry::Assumption> assumed;
  const auto left_out = [&](const char* parameter, const char* moment, double pressure) {
    if (!case_file::is_set(c, parameter, case_file::Stage::results))
      assumed.push_back(
          {fmt::format("{} pressure", moment), fmt::format("the default, {:g} mmHg; {} is not set",
                                                           pressure / units::mmHg, parameter)});
  };
  left_out("protocol.ed_pressure", "end-diastolic", c.protocol.ed_pressure);
  if (case_file::is_cycle(c) && !c.calibration.active && c.calibration.strains.empty())
    return assumed;  // nothing is contracted at given pressures
  if (c.cuff_systolic > 0.0)
    assumed.push_back({"end-systolic pressure",
                       fmt::format("{:.1f} mmHg, {:g} of the cuff's {:g} mmHg (Kelly et al. 1992)",
                                   c.protocol.es_pressure / units::mmHg, case_file::systolic_share,
                                   c.cuff_systolic / units::mmHg)});
  else
    left_out("protocol.es_pressure", "end-systolic", c.protocol.es_pressure);
  return assumed;
}

/// Whether a parameter whose name begins so is fitted.
bool fits(const Case& c, const char* family) {
  const std::vector<std::string> fitted = fitted_names(c);
  return std::any_of(fitted.begin(), fitted.end(),
                     [&](const std::string& name) { return name.starts_with(family); });
}

/// Muscle that a case does not fit to the heart that it shows.
std::vector<geometry::Assumption> assumed_muscle(const Case& c) {
  if (c.anatomy.source == case_file::AnatomySource::ellipsoid)
    return {};  // nothing of it was measured
  std::vector<geometry::Assumption> assumed;
  if (!fits(c, "passive."))
    assumed.push_back({"stiffness", "the case's, not fitted to this heart"});
  if (!fits_contractility(c))
    assumed.push_back({"contractility",
                       "the case's, not fitted to this heart: end-systolic and stroke volume, "
                       "ejection fraction and stress are those of such muscle"});
  return assumed;
}

/// What heartbeats were fitted to, and what was not measured of them.
void add_beats(const HeartbeatFit& fit, const Case& c, FitRecord& record) {
  for (const beating_wall::FittedDatum& d : fit.data)
    if (!std::isnan(d.measured))
      record.beats.push_back({d.name, d.unit, d.measured, d.model});
  for (const std::string& sentence : fit.left_alone)
    record.assumed.push_back({"heartbeats", sentence});
  if (!case_file::is_set(c, "circulation.period", case_file::Stage::results))
    record.assumed.push_back(
        {"heart rate", fmt::format("the default, {:.0f} beats a minute; circulation.period is not "
                                   "set",
                                   60.0 / c.circulation.period)});
}

/// Volumes of Klotz's curve beside the model's, and what the end-diastolic pressure costs.
void add_klotz(const calibrate::RecordedFit& fit, FitRecord& record) {
  for (const calibrate::RecordedVolume& v : fit.volumes)
    if (v.name.starts_with("Klotz"))
      record.klotz.push_back({v.name, v.pressure, v.target, v.model});
  std::string text =
      fmt::format("{:g} mmHg is taken for this person's", *fit.klotz_pressure / units::mmHg);
  for (const calibrate::OtherPressure& other : fit.other_pressures) {
    text += fmt::format("; with {:g} mmHg", other.pressure / units::mmHg);
    if (!other.parameters) {
      text += " there is no fit";
      continue;
    }
    for (const calibrate::Fitted& p : fit.fitted)
      text += fmt::format(" {} {:.3g}", p.name, (*other.parameters).*p.member);
    text += fmt::format(", unloaded {:.1f} ml", other.unloaded_volume / units::ml);
  }
  record.assumed.push_back({"filling pressure and Klotz's curve", text});
}

}  // namespace

std::vector<std::string> fitted_names(const Case& c) {
  std::vector<std::string> names = muscle_names(c.calibration);
  if (c.calibration.cycle)
    for (const case_file::BeatParameter& p : case_file::beat_fit(c).parameters)
      names.emplace_back(p.parameter->name);
  return names;
}

bool fits_contractility(const Case& c) {
  return fits(c, "active.") || fits(c, "muscle.contractility");
}

Case for_calibration(Case c) {
  c.engine = case_file::EngineChoice::quasi_static;
  return c;
}

std::optional<Case> on_coarse_wall(Case c) {
  if (!c.calibration.fits_muscle() || c.quasi_static.order != 2 ||
      c.quasi_static.edge_length >= shortest_of_coarse)
    return {};
  c.quasi_static.edge_length = coarse_edge;
  c.quasi_static.layers = 1;
  return c;
}

namespace {

/// The walls of a fit in their order, as far as it is known before.
std::vector<calibrate::FittedMesh> walls_of(const Case& c,
                                            const std::optional<anatomy::MeshResult>& coarse,
                                            const anatomy::MeshResult& mesh, calibrate::Plan task,
                                            std::size_t other_pressures) {
  const bool is_loaded = case_file::is_loaded(c);
  std::vector<calibrate::FittedMesh> walls;
  if (coarse)
    walls.push_back({coarse->mesh.nodes.size(), is_loaded, calibrate::parts_of(alone(task))});
  task.starts_near = coarse.has_value();
  walls.push_back({mesh.mesh.nodes.size(), is_loaded, calibrate::parts_of(task)});
  task.starts_near = true;
  walls.resize(walls.size() + other_pressures,
               {mesh.mesh.nodes.size(), is_loaded, calibrate::parts_of(alone(task))});
  return walls;
}

/// The fit of the muscle at given pressures, and its files; collective.
void fit_muscle(const Case& c, const anatomy::MeshResult& mesh,
                const std::optional<anatomy::MeshResult>& coarse,
                const std::filesystem::path& folder) {
  const Targets targets = targets_of(c, mesh, folder);
  calibrate::Plan task = plan(c, targets, mesh.regions);
  const bool klotz = task.passive == FittedPassive::klotz;
  set_seen_volume(c, mesh, task);
  FitStart start{{.C_a = c.passive.C_a, .T_scale = c.active.T_scale}};
  std::vector<std::filesystem::path> records{folder / coarse_answers_name, folder / answers_name};
  const double error = c.calibration.pressure_error;
  std::vector<double> other_pressures;
  if (klotz && error > 0.0)
    other_pressures = {task.ed_pressure - error, task.ed_pressure + error};
  calibrate::FitForecast forecast(walls_of(c, coarse, mesh, task, other_pressures.size()));
  if (coarse)
    if (auto first =
            fit_coarse(c, *coarse, mesh, task, start.parameters, {forecast, records.front()})) {
      start = std::move(*first);
      task.starts_near = true;
      task.slopes = start.slopes;
    }
  FittedWall found = fit_wall(c, mesh, targets, task, start, {forecast, records.back()});
  calibrate::Fit& fit = found.fit;
  task.slopes = fit.slopes;
  for (const double pressure : other_pressures) {
    records.push_back(folder / fmt::format("answers_{}.bin", records.size() - 1));
    fit.other_pressures.push_back(
        fit_at(pressure, c, mesh, task, start_at(found), {forecast, records.back()}));
  }
  parallel::on_root([&] {
    if (found.unloaded)
      write_unloaded(*found.unloaded, folder / unloaded_shape_name);
    for (const std::filesystem::path& record : records)
      std::filesystem::remove(record);
    calibrate::history_table(fit).write_csv(folder / "calibration.csv");
    if (!fit.segments.empty())
      calibrate::contractility_table(fit.segments).write_csv(folder / contractility_name);
    write_file(folder / muscle_text, calibrate::text(task, fit));
    write_file(for_readers(folder / calibration_name), calibrate::json(task, fit));
    heartbeat::Archive archive;
    store(calibrate::recorded(task, fit), archive);
    archive.write(folder / calibration_name);  // last: what is there is whole
  });
}

bool is_there(const std::filesystem::path& file) {
  return parallel::root_says(std::filesystem::exists(file));
}

/// The wall that beats: that of the mesh, or what is left of it without load.
anatomy::MeshResult stress_free_wall(const Case& c, const anatomy::MeshResult& mesh,
                                     const std::filesystem::path& folder) {
  anatomy::MeshResult wall = mesh;
  if (!case_file::is_loaded(c))
    return wall;
  const auto kept = folder / stress_free_name;
  if (!is_there(kept)) {
    const implicit::Unloaded unloaded =
        find_unloaded(c, mesh.mesh, folder, folder / unloaded_shape_name);
    parallel::on_root([&] {
      write_unloaded(unloaded, kept);
      std::filesystem::remove(folder / search_record);
    });
  }
  wall.mesh = mesh::with_nodes(
      mesh.mesh, load_unloaded(heartbeat::Archive::read(kept), mesh.mesh.nodes.size()).nodes);
  return wall;
}

/// What is told of all fits, of which the muscle's is then no file of its own any more.
void write_text(const case_file::Calibration& k, const std::filesystem::path& folder) {
  const auto muscle = folder / muscle_text;
  if (k.fits_muscle() && !std::filesystem::exists(muscle))
    return;  // written before the run was stopped
  std::string text = k.fits_muscle() ? read_file(muscle) : "";
  if (k.cycle)
    text += (text.empty() ? "" : "\n") + read_file(folder / beating_wall::heartbeats_text);
  write_file(folder / "calibration.txt", text);
  std::filesystem::remove(muscle);
}

/// What is told, and what later stages begin with.
void finish(const Case& c, const Case& fitted, const std::filesystem::path& folder) {
  write_text(c.calibration, folder);
  write_file(folder / "calibrated.toml", fragment(fitted, fitted_names(c)));
  if (std::filesystem::exists(folder / stress_free_name))
    std::filesystem::rename(folder / stress_free_name, folder / unloaded_shape_name);
}

}  // namespace

void make_calibration(const Case& c, const anatomy::MeshResult& mesh, const CoarseWalls& coarse,
                      const std::filesystem::path& folder) {
  const case_file::Calibration& k = c.calibration;
  if (k.fits_muscle() && !is_there(folder / calibration_name))
    fit_muscle(c, mesh, coarse.of_muscle, folder);
  const Case fitted_muscle = with_muscle(c, folder);
  if (k.cycle && !is_there(folder / heartbeats_name))
    static_cast<void>(
        beating_wall::fit_heartbeats(fitted_muscle, stress_free_wall(fitted_muscle, mesh, folder),
                                     coarse.of_beats ? &*coarse.of_beats : nullptr, folder));
  const Case fitted = with_beats(fitted_muscle, folder);
  parallel::on_root([&] { finish(c, fitted, folder); });
}

Case calibrated(Case c, const std::filesystem::path& file) {
  for (const std::string& name : muscle_names(c.calibration))
    c.origin[name] = for_readers(file).string();
  if (c.calibration.contractility == case_file::FittedContractility::segments)
    c.contractility_file = contractility_name;
  return with(std::move(c), load_parameters(heartbeat::Archive::read(file)));
}

Case with_muscle(const Case& c, const std::filesystem::path& calibration,
                 const std::filesystem::path& beat) {
  if (!c.calibration.fits_muscle())
    return c;
  const auto corrected = beat / confirmation_name;
  const bool is_corrected = !beat.empty() && std::filesystem::exists(corrected);
  return calibrated(c, is_corrected ? corrected : calibration / calibration_name);
}

Case fitted(const Case& c, const std::filesystem::path& calibration,
            const std::filesystem::path& beat) {
  return with_beats(with_muscle(c, calibration, beat), calibration);
}

bool correct(const Case& c, const std::filesystem::path& calibration_folder,
             const heartbeat::Beat& beat, const std::filesystem::path& folder) {
  const calibrate::RecordedFit fit = read_fit(calibration_folder);
  const auto file = folder / confirmation_name;
  Confirmation record{fit.parameters, 0.0, {}};
  if (std::filesystem::exists(file))
    record = read_confirmation(file);
  record.tolerance = c.calibration.tolerance;
  if (!record.beats.empty() && record.beats.back().parameters == record.parameters)
    record.beats.pop_back();  // this very beat, recorded before the run was stopped
  const std::vector<ConfirmedVolume> found = volumes_of(fit, beat);
  const bool is_within = std::all_of(found.begin(), found.end(), [&](const ConfirmedVolume& v) {
    return v.within(record.tolerance);
  });
  record.beats.push_back({record.parameters, found, is_within});
  const bool again = !is_within && c.calibration.confirm && record.beats.size() < most_beats;
  if (again) {
    record.parameters = corrected(fit, record.parameters, found);
    log::info("the beat's volumes are off by more than {:g}%; once more with {}",
              100.0 * record.tolerance, calibrate::json_of(record.parameters).dump());
    std::filesystem::remove(folder / heartbeat::checkpoint_name);  // before the new parameters
  }
  write_confirmation(record, file);
  if (!again) {
    std::vector<std::string> names = muscle_names(c.calibration);
    Case last = calibrated(c, file);
    if (c.calibration.cycle) {
      const HeartbeatFit beats = read_heartbeats(calibration_folder / heartbeats_name);
      last = with_values(std::move(last), beats, calibration_folder / heartbeats_json);
      for (const beating_wall::FittedValue& p : beats.parameters)
        names.push_back(p.parameter);
    }
    write_file(folder / "calibrated.toml", fragment(last, names));
  }
  return again;
}

FitRecord fit_record(const Case& c, const std::filesystem::path& calibration,
                     const std::filesystem::path& beat) {
  FitRecord all;
  all.assumed = assumed_pressures(c);
  for (geometry::Assumption& a : assumed_muscle(c))
    all.assumed.push_back(std::move(a));
  if (!c.calibration.asked())
    return all;
  if (c.calibration.cycle)
    add_beats(read_heartbeats(calibration / heartbeats_name), c, all);
  if (!c.calibration.fits_muscle())
    return all;
  const Confirmation record = read_confirmation(beat / confirmation_name);
  for (const ConfirmedVolume& v : record.beats.back().volumes)
    all.volumes.push_back(
        {v.name, v.measured, v.quasi_static, v.beat, v.within(c.calibration.tolerance)});
  const calibrate::RecordedFit fit = read_fit(calibration);
  if (fit.klotz_pressure)
    add_klotz(fit, all);
  if (fit.shape)
    all.shape = report::FittedShape{fit.shape->after.rms, fit.shape->after.bias,
                                    fit.shape->before.rms, fit.shape->before.bias};
  all.segments = fit.segments;
  return all;
}

}  // namespace lv::pipeline
