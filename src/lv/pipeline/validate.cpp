#include "lv/pipeline/validate.hpp"

#include "lv/base/log.hpp"
#include "lv/base/log_count.hpp"
#include "lv/base/mistakes.hpp"
#include "lv/base/units.hpp"
#include "lv/beating_wall/activation.hpp"
#include "lv/beating_wall/base_motion.hpp"
#include "lv/beating_wall/filling_reach.hpp"
#include "lv/case_file/beat_fit.hpp"
#include "lv/case_file/family.hpp"
#include "lv/cine/strain.hpp"
#include "lv/cine/strain_targets.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/pipeline/calibration.hpp"
#include "lv/pipeline/circulation.hpp"
#include "lv/pipeline/cost.hpp"
#include "lv/pipeline/measured_volumes.hpp"
#include "lv/pipeline/stages.hpp"
#include "lv/pipeline/study.hpp"
#include "lv/scar/infarct.hpp"
#include "lv/solid/endocardial_surface.hpp"
#include "lv/work/ingredients.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace lv::pipeline {
namespace {

using case_file::Case;
using case_file::Stage;
using units::mmHg;

/// A short name for the last line, and what it means.
struct Warning {
  std::string name, text;
};

/// What the last line calls a warning of the shape, by the part of the anatomy that it is about.
std::string name_of(const geometry::Assumption& warning) {
  static const std::map<std::string, std::string> names{{"septum", "septum assumed"},
                                                        {"orientation", "orientation"},
                                                        {"contours", "contours off the wall"},
                                                        {"fibres", "fibres out of the wall"},
                                                        {"size", "size of no human heart"},
                                                        {"cut cavity", "cavity cut off"},
                                                        {"cut base", "base cut"},
                                                        {"tip", "tip not shown"},
                                                        {"slices", "slices alike"},
                                                        {"moved slices", "slices moved"},
                                                        {"borders", "borders doubtful"},
                                                        {"scar", "scar taken as healthy"},
                                                        {"wall", "notches in the wall"},
                                                        {"early diastole", "end-diastolic shape"}};
  const auto name = names.find(warning.part);
  return name == names.end() ? warning.part : name->second;
}

/// A cavity that fills by less than this from early to end-diastole is worth a question.
constexpr double little_filling = 1.25;

/// Of the case, or of the first of its study that has such a chamber.
std::string study_beyond_beat(const Case& c) {
  for (const case_file::Member& member : case_file::family(c.study))
    if (std::string beyond = chamber_beyond_beat(case_file::under(member.factors, c));
        !beyond.empty())
      return member.name == "case" ? beyond
                                   : fmt::format("in {} of the study, {}", member.name, beyond);
  return "";
}

/// What a run says of the case as it begins.
std::vector<Warning> odd_in(const Case& c) {
  std::vector<Warning> odd{{"fit outside heartbeats", fit_outside_heartbeats(c)},
                           {"left-handed fibres", left_handed_fibres(c)},
                           {"high filling pressure", high_filling_pressure(c)},
                           {"high calcium", high_calcium(c)},
                           {"calcium of another rate", calcium_beside_rate(c)},
                           {"another end-diastole", unlike_end_diastole(c)},
                           {"base away from apex", beating_wall::base_away_from_apex(c)}};
  odd.erase(std::remove_if(odd.begin(), odd.end(), [](const Warning& w) { return w.text.empty(); }),
            odd.end());
  return odd;
}

std::vector<Warning> warnings_of(const Case& c, const anatomy::Shape& shape, double cavity) {
  std::vector<Warning> warnings;
  for (const std::string& text : c.without_effect)
    warnings.push_back({"no effect", text});
  if (std::string slow = slow_relaxation(c); !slow.empty())
    warnings.push_back({"slow relaxation", std::move(slow)});
  if (std::string beyond = study_beyond_beat(c); !beyond.empty())
    warnings.push_back({"contraction beyond the beat", std::move(beyond)});
  for (Warning& odd : odd_in(c))
    warnings.push_back(std::move(odd));
  for (const geometry::Assumption& a : shape.warnings)
    warnings.push_back({name_of(a), a.text});
  const double edv = c.calibration.edv;
  if (c.calibration.passive != calibrate::FittedPassive::none && !case_file::is_loaded(c) &&
      edv < little_filling * cavity)
    warnings.push_back(
        {"little filling",
         fmt::format("calibrate.edv is {:.1f} ml and the shape that is taken as free of stress has "
                     "{:.1f} ml: if it is that of end-diastole, set unloaded.pressure",
                     1e-3 * edv, 1e-3 * cavity)});
  if (std::string little = little_ejection(c, shape); !little.empty())
    warnings.push_back({"little ejection", std::move(little)});
  if (case_file::is_loaded(c) && c.calibration.passive == calibrate::FittedPassive::none &&
      std::abs(c.unloaded.pressure / c.protocol.ed_pressure - 1.0) < 0.05)
    warnings.push_back(
        {"stiffness not fitted",
         "the stiffness is the case's, not fitted to this heart: with calibrate.passive = "
         "\"klotz\" it follows from the end-diastolic shape, its pressure and Klotz's curve"});
  if (case_file::is_loaded(c) && !fits_contractility(c))
    warnings.push_back({"contractility not fitted",
                        "the contractility is the case's, not fitted to this heart, and so is its "
                        "ejection fraction: with calibrate.active = true it follows from the "
                        "measured end-systolic volume (calibrate.esv)"});
  return warnings;
}

std::string next_command(const Case& c) {
  return fmt::format("ventricle run {}", c.file.string());
}

/// Names, without repeats. Of the infarct the log has warned already.
std::string names_of(const std::vector<Warning>& warnings, bool warned_of_infarct) {
  std::vector<std::string> names;
  if (warned_of_infarct)
    names.emplace_back("infarct");
  for (const Warning& w : warnings)
    if (std::find(names.begin(), names.end(), w.name) == names.end())
      names.push_back(w.name);
  return names.empty() ? "no warnings" : fmt::format("warnings above: {}", fmt::join(names, ", "));
}

std::string describe_mesh(const mesh::Mesh& m) {
  const mesh::Quality q = mesh::quality(m);
  return fmt::format(
      "  mesh: {} elements, {} nodes, edges {:.2f} mm in the mean; worst element {} at ({:.1f}, "
      "{:.1f}, {:.1f}) mm with scaled Jacobian {:.2f}\n",
      q.cells, q.nodes, q.edge_length.mean, q.worst_cell, q.worst_place.x(), q.worst_place.y(),
      q.worst_place.z(), q.scaled_jacobian.min);
}

std::string describe_shape(const Case& c, const anatomy::Shape& shape, double cavity,
                           const mesh::Mesh& m) {
  std::string text =
      fmt::format("{}: valid\n  {}: cavity {:.2f} ml, wall {:.2f} ml\n", c.file.string(),
                  case_file::is_loaded(c) ? "the shape that was seen" : "early diastole",
                  1e-3 * cavity, 1e-3 * mesh::quality(m).wall_volume);
  if (case_file::is_loaded(c))
    text += fmt::format("  it bears {:.2f} mmHg; the wall without load will be found from it\n",
                        c.unloaded.pressure / mmHg);
  const auto is_warning = [&](const std::string& note) {
    return std::any_of(shape.warnings.begin(), shape.warnings.end(),
                       [&](const geometry::Assumption& a) { return a.text == note; });
  };
  if (shape.quality) {
    report::QualitySheet sheet = *shape.quality;
    std::erase_if(sheet.notes, is_warning);  // they stand further down
    return text + report::quality_text(sheet);
  }
  for (const std::string& note : shape.notes)
    if (!is_warning(note))
      text += fmt::format("  note: {}\n", note);
  return text;
}

/// What heartbeats are fitted to, and what is left as it is.
std::string describe_beat_fit(const Case& c) {
  const case_file::BeatFit fit = case_file::beat_fit(c);
  std::string text;
  for (const case_file::BeatParameter& p : fit.parameters) {
    const case_file::BeatDatum& d = fit.data[p.datum];
    text += fmt::format("  heartbeats: {} ({}) is fitted to {} = {:g} {}\n", p.words,
                        p.parameter->name, d.key, d.shown(d.measured), d.unit);
  }
  for (const std::string& sentence : fit.left_alone)
    text += fmt::format("  {}\n", sentence);
  return text;
}

}  // namespace

void warn_of(const Case& c) {
  for (const std::string& what : c.without_effect)
    log::warn("{}", what);
  for (const Warning& odd : odd_in(c))
    log::warn("{}", odd.text);
}

std::string fit_outside_heartbeats(const Case& c) {
  if (!case_file::is_cycle(c) || !c.calibration.fits_muscle() || c.calibration.cycle)
    return "";
  return fmt::format(
      "[calibrate] fits outside of the heartbeats, at protocol.ed_pressure ({:g} mmHg) and "
      "protocol.es_pressure ({:g} mmHg): the volumes of a beat are those of the pressures that the "
      "circulation makes, and need not be the measured ones. calibrate.cycle = true fits the "
      "heartbeats themselves",
      c.protocol.ed_pressure / mmHg, c.protocol.es_pressure / mmHg);
}

std::string left_handed_fibres(const Case& c) {
  const mesh::FibreRule& rule = c.fibres;
  if (rule.helix_endo <= rule.helix_epi)
    return "";
  constexpr double degrees = 180.0 / std::numbers::pi;
  return fmt::format(
      "fibres.helix_endo = {0:g} deg and fibres.helix_epi = {1:g} deg make a left-handed helix at "
      "the endocardium, which no human heart has: here the right-handed one is negative. Most "
      "programs count the other way; for their {0:g} and {1:g} write {2:g} and {3:g}",
      rule.helix_endo * degrees, rule.helix_epi * degrees, -rule.helix_endo * degrees,
      -rule.helix_epi * degrees);
}

std::string high_filling_pressure(const Case& c) {
  constexpr double most = beating_wall::worst_filling;
  for (const auto& [name, p] :
       {std::pair("protocol.ed_pressure", c.protocol.ed_pressure),
        std::pair("circulation.windkessel.p_ven", c.circulation.windkessel.p_ven)})
    if (case_file::is_set(c, name, case_file::Stage::results) && p > most)
      return fmt::format(
          "{} is {:g} mmHg, more than the left ventricle of a patient is filled with ({:g} mmHg, "
          "in the worst failure): is its unit right? 1 kPa is 7.5 mmHg",
          name, p / mmHg, most / mmHg);
  return "";
}

std::string high_calcium(const Case& c) {
  constexpr double most = 10.0;  // [uM]
  const double peak = c.protocol.calcium.Ca_max;
  if (!case_file::is_set(c, "calcium.Ca_max", case_file::Stage::results) || peak <= most)
    return "";
  return fmt::format(
      "calcium.Ca_max is {:g} uM, and free calcium in a cell of the heart's muscle rises to about "
      "1 uM: is its unit right? 1 mM is 1000 uM",
      peak);
}

std::string unlike_end_diastole(const Case& c) {
  if (!case_file::is_loaded(c) || case_file::is_cycle(c))
    return "";
  const double seen = c.unloaded.pressure;
  const double filled = c.protocol.ed_pressure;
  const bool differs = std::abs(seen - filled) > std::min(1.0 * mmHg, 0.1 * filled);
  const bool is_end_diastole = c.anatomy.source == case_file::AnatomySource::cine &&
                               c.anatomy.cine.moment == case_file::ShapeMoment::end_diastole;
  if (!differs || (!is_end_diastole && seen < filled))
    return "";
  return fmt::format(
      "the shape that was seen bears {:g} mmHg (unloaded.pressure) and the model is filled to {:g} "
      "mmHg (protocol.ed_pressure): the end-diastole of the model is not that of the images, and "
      "its volume will be another",
      seen / mmHg, filled / mmHg);
}

void check_on_wall(const Case& c, const anatomy::MeshResult& wall) {
  check_room(c, wall.mesh);
  static_cast<void>(case_file::segment_factors(c));            // whose table may be none
  static_cast<void>(beating_wall::activation_times(c, wall));  // which may not fit to the wall
  static_cast<void>(
      beating_wall::base_motion(c, wall.mesh));  // whose table may not fit to the beat
  static_cast<void>(cine::strain_targets(c, wall.regions));
  check_begin(c, wall.mesh);
}

CheckedCase check_case(const Case& c) {
  Mistakes mistakes;
  CheckedCase checked;
  mistakes.attempt([&] { checked.strain = cine::check_strain(c); });
  log::info("looking at the anatomy ...");  // each of these may take long
  mistakes.attempt(
      [&] { checked.shape = anatomy::make_anatomy(work::stage_view(c, Stage::anatomy)); });
  mistakes.attempt([&] { scar::require_infarct(c); });
  mistakes.raise();
  check_measured_volumes(c, checked.shape);
  checked.members = check_study(c);
  log::info("looking at the mesh ...");
  const int said = log::warnings();
  checked.wall = make_mesh(work::stage_view(c, Stage::mesh), checked.shape);
  checked.warned_of_infarct = log::warnings() > said;  // of the mesh itself there are none
  check_on_wall(c, checked.wall);
  return checked;
}

std::string validate(const Case& c) {
  const CheckedCase checked = check_case(c);
  const anatomy::MeshResult& result = checked.wall;
  const double cavity = solid::EndocardialSurface(result.mesh).volume(result.mesh.nodes);
  std::string text = describe_shape(c, checked.shape, cavity, result.mesh);
  if (const auto targets = cine::strain_targets(c, result.regions); !targets.empty())
    text += fmt::format("  strains of {} segments to fit to\n", targets.size());
  text += checked.strain + describe_mesh(result.mesh);
  if (const std::string infarct = scar::describe_infarct(c, result); !infarct.empty())
    text += fmt::format("  {}\n", infarct);
  if (c.calibration.cycle)
    text += describe_beat_fit(c);
  if (checked.members > 0)
    text += fmt::format("  a study of {} cases: ventricle study {}\n", checked.members,
                        c.file.string());
  const std::vector<Warning> warnings = warnings_of(c, checked.shape, cavity);
  for (const Warning& w : warnings)
    text += fmt::format("  warning: {}\n", w.text);
  const Cost cost = cost_of(c, checked.shape, result);
  return text + cost.details +
         fmt::format("on one core: {}; {}; next: {}\n", cost.words,
                     names_of(warnings, checked.warned_of_infarct), next_command(c));
}

}  // namespace lv::pipeline
