#include "lv/report/summary.hpp"

#include "lv/base/json_file.hpp"
#include "lv/base/units.hpp"
#include "lv/report/cycle_tables.hpp"
#include "lv/report/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::report {
namespace {

using analysis::RegionalValue;
using analysis::Results;
using analysis::Statistics;
using analysis::VentricleShape;
using Json = nlohmann::ordered_json;
using units::degree;
using units::mmHg;

constexpr double millijoule = 1e-3;  ///< of a mN mm

/// A number rounded to seven digits; null when it is missing.
Json number(double value) {
  if (std::isnan(value))
    return nullptr;
  return std::stod(fmt::format("{:.7g}", value));
}

Json shape_json(const VentricleShape& s) {
  return {{"time_s", number(s.time)},
          {"pressure_mmHg", number(s.pressure / mmHg)},
          {"cavity_volume_ml", number(1e-3 * s.cavity_volume)},
          {"wall_volume_ml", number(1e-3 * s.wall_volume)},
          {"apex_endo_z_mm", number(s.apex_endo_z)},
          {"apex_epi_z_mm", number(s.apex_epi_z)},
          {"long_axis_mm", number(s.long_axis)},
          {"base_endo_radius_mm", number(s.base_endo_radius)},
          {"base_axial_shift_mm", number(s.base_axial_shift)}};
}

Json statistics_json(const Statistics& s, const std::string& unit) {
  return {{"mean", number(s.mean)}, {"sd", number(s.sd)},   {"p1", number(s.p1)},
          {"p50", number(s.p50)},   {"p99", number(s.p99)}, {"unit", unit}};
}

/// The statistics of a region at every moment, by the moment's name and the quantity's.
Json region_json(const Results& results, const std::string& region) {
  Json json;
  for (const auto& r : results.regional)
    if (r.region == region)
      json[r.state][r.quantity] = statistics_json(r.statistics, r.unit);
  return json;
}

/// The zones of an infarcted wall, in the paper's sections 3.3-3.4 U^in, U^bz and U^un.
constexpr std::array zones{"infarct", "border", "remote"};

bool has_zones(const Results& results) {
  return std::any_of(results.regional.begin(), results.regional.end(),
                     [](const RegionalValue& r) { return r.scheme == "zone"; });
}

const RegionalValue& at_end_systole(const Results& results, const std::string& region,
                                    const std::string& quantity) {
  return *std::find_if(
      results.regional.begin(), results.regional.end(), [&](const RegionalValue& r) {
        return r.state == heartbeat::end_systole && r.region == region && r.quantity == quantity;
      });
}

Json zones_json(const Results& results) {
  Json json;
  for (const char* zone : zones) {
    json[zone] = {{"volume_ml", number(1e-3 * at_end_systole(results, zone, "J").volume)}};
    json[zone].update(region_json(results, zone));
  }
  return json;
}

/// Tension, stress and strains at end-systole in each zone, as the paper's sections 3.3-3.4 give
/// them.
std::string zones_text(const Results& results) {
  const auto in_zones = [&](const auto& cell) {
    std::string cells;
    for (const char* zone : zones)
      cells += fmt::format("{:>18}", cell(zone));
    return cells + "\n";
  };
  std::string text = fmt::format("  {:<24}{}", "at end-systole",
                                 in_zones([](const char* zone) { return std::string(zone); }));
  text +=
      fmt::format("  {:<24}{}", "whole elements (ml)", in_zones([&](const char* zone) {
                    return fmt::format("{:.2f}", 1e-3 * at_end_systole(results, zone, "J").volume);
                  }));
  for (const char* quantity : {"active_tension", "fibre_stress", "fibre_strain",
                               "circumferential_strain", "longitudinal_strain", "radial_strain"})
    text +=
        fmt::format("  {:<24}{}", quantity, in_zones([&](const char* zone) {
                      const auto& v = at_end_systole(results, zone, quantity);
                      return fmt::format("{:.3f} +- {:.3f}", v.statistics.mean, v.statistics.sd);
                    }));
  return text + "\n";
}

Json unloaded_json(const UnloadedShape& u) {
  return {{"seen_under_mmHg", number(u.pressure / mmHg)},
          {"seen_volume_ml", number(1e-3 * u.seen_volume)},
          {"unloaded_volume_ml", number(1e-3 * u.unloaded_volume)},
          {"loaded_again_volume_ml", number(1e-3 * u.loaded_volume)},
          {"largest_distance_mm", number(u.largest)},
          {"rms_distance_mm", number(u.rms)},
          {"klotz_volume_ml", number(1e-3 * u.klotz_volume)},
          {"smoothing", number(u.smoothing)},
          {"dent_deg", number(u.folds.dent / units::degree)},
          {"nearest_to_itself", number(u.folds.approach)},
          {"largest_stretch", number(u.folds.stretch)}};
}

std::string unloaded_text(const UnloadedShape& u) {
  return fmt::format(
      "  the wall was seen under {:.2f} mmHg ({:.2f} ml); without load it holds {:.2f} ml, loaded "
      "again\n  {:.2f} ml, and its nodes are off by {:.4f} mm at most ({:.4f} mm rms); Klotz et "
      "al. (2006) expect\n  {:.1f} ml without load. It turns inwards by {:.0f} degrees at most "
      "where the seen wall does not{}\n\n",
      u.pressure / mmHg, 1e-3 * u.seen_volume, 1e-3 * u.unloaded_volume, 1e-3 * u.loaded_volume,
      u.largest, u.rms, 1e-3 * u.klotz_volume, u.folds.dent / units::degree,
      u.smoothing == 0.0
          ? ""
          : ";\n  the wall that loads to the very shape would be folded, so this is a smooth one");
}

/// The curve is a mean over hearts: assumed of this one.
std::string klotz_text(const std::vector<KlotzVolume>& volumes) {
  if (volumes.empty())
    return "";
  std::string text = fmt::format("  {:<34}{:>14}{:>14}{:>14}\n", "Klotz's curve, assumed (ml)",
                                 "at mmHg", "curve", "fitted model");
  for (const KlotzVolume& v : volumes)
    text += fmt::format("  {:<34}{:>14.2f}{:>14.2f}{:>14.2f}\n", v.name, v.pressure / mmHg,
                        1e-3 * v.target, 1e-3 * v.model);
  return text + "\n";
}

std::vector<Judgement> judge(const RunFacts& facts, const heartbeat::Beat& beat, const Results& r) {
  const heartbeat::NamedMoment* end = beat.find(heartbeat::end_systole);
  return judge(JudgedBeat{r, facts.muscle_density, has_zones(r),
                          end != nullptr && end->by_criterion, facts.base_is_held,
                          beat.cycle ? &beat.cycle->beats.back() : nullptr,
                          beat.cycle ? beat.cycle->period : 0.0});
}

/// The end of a range; null where it has none.
Json bound(double value) {
  return std::isfinite(value) ? number(value) : Json();
}

Json judgement_json(const Judgement& j) {
  const PlausibleRange& range = *j.range;
  return {{"quantity", range.quantity},
          {"label", range.label},
          {"value", number(j.value)},
          {"unit", range.unit},
          {"low", bound(j.low)},
          {"high", bound(j.high)},
          {"source", range.source},
          {"answer", name(j.answer)},
          {"reason", j.reason},
          {"impossible", j.is_impossible},
          {"of", range.population == Population::any_wall ? "computation" : "heart"}};
}

std::string plausibility_text(const std::vector<Judgement>& judgements) {
  std::string text = fmt::format("  {:<56}{:>10} {:<4}{:>16}\n",
                                 "is it plausible? (sources: summary.json)", "", "", "expected");
  for (const Judgement& j : judgements) {
    const PlausibleRange& range = *j.range;
    text += fmt::format("  {:<56}{:>10.3f} {:<4}{:>16}  {}\n", range.label, j.value,
                        range.unit == "1" ? "" : range.unit,
                        fmt::format("{:.4g} to {:.4g}", j.low, j.high),
                        j.is_impossible                      ? "IMPOSSIBLE"
                        : j.answer == Answer::not_applicable ? "not applicable: " + j.reason
                                                             : name(j.answer));
  }
  return text;
}

/// The run's own warnings, and one for each number that cannot be.
std::vector<std::string> warnings(const RunFacts& facts, const std::vector<Judgement>& judgements) {
  std::vector<std::string> all = facts.warnings;
  for (std::string& sentence : impossible_values(judgements))
    all.push_back(std::move(sentence));
  return all;
}

/// Assumptions that are no warnings, then warnings.
std::string remarks_text(const RunFacts& facts, const std::vector<Judgement>& judgements) {
  const std::vector<std::string> all = warnings(facts, judgements);
  std::string text;
  for (const geometry::Assumption& a : facts.assumed)
    if (std::find(all.begin(), all.end(), a.text) == all.end())
      text += fmt::format("  assumed: {}: {}\n", a.part, a.text);
  for (const std::string& warning : all)
    text += fmt::format("  warning: {}\n", warning);
  return text.empty() ? text : "\n" + text;
}

Json infarct_json(const RunFacts& facts, const Results& r) {
  double volume = 0.0;
  for (const SegmentScar& s : facts.scar)
    volume += s.volume;
  return {{"volume_ml", number(1e-3 * volume)},
          {"mass_g", number(1e3 * facts.muscle_density * volume)},
          {"percent_of_wall", number(100.0 * volume / r.early_diastole.wall_volume)}};
}

/// Volumes that parameters were fitted to.
void add_fits(const RunFacts& facts, Json& json) {
  for (const FittedVolume& v : facts.fitted)
    json["calibration"].push_back({{"volume", v.name},
                                   {"measured_ml", number(1e-3 * v.measured)},
                                   {"quasi_static_ml", number(1e-3 * v.quasi_static)},
                                   {"beat_ml", number(1e-3 * v.beat)},
                                   {"within_tolerance", v.within_tolerance}});
  for (const FittedOfBeat& v : facts.fitted_beats)
    json["heartbeats_fitted"].push_back({{"datum", v.name},
                                         {"unit", v.unit},
                                         {"measured", number(v.measured)},
                                         {"fit", number(v.fit)},
                                         {"beat", number(v.beat)},
                                         {"within_tolerance", v.within_tolerance}});
  for (const KlotzVolume& v : facts.klotz)
    json["klotz"].push_back({{"volume", v.name},
                             {"pressure_mmHg", number(v.pressure / mmHg)},
                             {"target_ml", number(1e-3 * v.target)},
                             {"model_ml", number(1e-3 * v.model)}});
  if (const auto& shape = facts.fitted_shape)
    json["shape_fitted"] = {{"rms_mm", number(shape->rms)},
                            {"bias_mm", number(shape->bias)},
                            {"rms_before_mm", number(shape->rms_before)},
                            {"bias_before_mm", number(shape->bias_before)}};
}

/// The rows of contractility.csv.
void add_contractility(const Table& table, Json& json) {
  const auto names = table.words("name");
  for (std::size_t i = 0; i < names.size(); ++i) {
    Json row{{"name", names[i]}};
    for (const char* column :
         {"segment", "factor", "standard_error_of_logarithm", "low_95", "high_95", "resolution"})
      row[column] = number(table.numbers(column)[i]);
    json["contractility"].push_back(std::move(row));
  }
}

/// What is to be thought of the numbers.
void add_remarks(const RunFacts& facts, const Results& r, const std::vector<Judgement>& judgements,
                 Json& json) {
  for (const Judgement& j : judgements)
    json["plausibility"].push_back(judgement_json(j));
  json["assumptions"] = Json::array();
  for (const geometry::Assumption& a : facts.assumed)
    json["assumptions"].push_back({{"part", a.part}, {"text", a.text}});
  json["warnings"] = warnings(facts, judgements);
  std::vector<std::string> moments;
  for (const auto& [moment, shape] : r.moments)
    moments.push_back(moment);
  for (const auto& [path, mark] : marks(facts, moments))
    json["marks"][path] = name(mark);
}

/// Of the wall, after the calcium of a beat begins; null: all of it is activated at once.
Json latest_activation(const heartbeat::Beat& beat) {
  const auto& times = beat.activation_times;
  return times.empty() ? Json() : number(1e3 * *std::max_element(times.begin(), times.end()));
}

/// Null where none was kept.
Json energy_json(const heartbeat::EnergyBalance& e) {
  if (!e.is_known())
    return {};
  return {{"work_of_pressure_mJ", number(millijoule * e.pressure)},
          {"work_of_muscle_mJ", number(millijoule * e.muscle)},
          {"stored_mJ", number(millijoule * e.stored)},
          {"kinetic_mJ", number(millijoule * e.kinetic)},
          {"work_on_supports_mJ", number(millijoule * e.supports)},
          {"viscous_mJ", number(millijoule * e.viscosity)},
          {"work_of_moving_base_mJ", number(millijoule * e.base)},
          {"missing_percent", number(100.0 * e.error())}};
}

Json cycle_json(const heartbeat::Beat& beat) {
  const circulation::Cycle& cycle = *beat.cycle;
  Json last = Json::object();
  for (const auto& [name, value] : beat_numbers(cycle.beats.back()))
    last[name] = number(value);
  return {{"beats", cycle.beats.size()},
          {"is_limit_cycle", cycle.is_limit},
          {"was_cut_short", cycle.cut_short},
          {"leaps", cycle.leaps},
          {"largest_change_of_last_beat", number(cycle.change)},
          {"change_to_come", cycle.to_come > 0.0 ? number(cycle.to_come) : Json()},
          {"last_beat", std::move(last)},
          {"last_activation_ms", latest_activation(beat)},
          {"largest_volume_gap", number(cycle.volume_gap)},
          {"energy_of_last_beat", energy_json(beat.energy)}};
}

/// How the phases, or the heartbeats, ended.
void add_ends(const heartbeat::Beat& beat, Json& json) {
  if (beat.cycle)
    json["cycle"] = cycle_json(beat);
  else
    for (const heartbeat::NamedMoment& m : beat.moments)
      json[m.phase + "_was_steady"] = m.by_criterion;
}

/// The last of several heartbeats.
std::string cycle_text(const heartbeat::Beat& beat) {
  const heartbeat::EnergyBalance& e = beat.energy;
  const std::string text =
      fmt::format("  beat {}\n{}", beat.cycle->beats.size(), beat_text(beat.cycle->beats.back()));
  if (!e.is_known())
    return text + "\n";
  return text +
         fmt::format(
             "  {:<26} {:.4g} mJ, of the cavity's pressure {:.4g} mJ{}, stored {:.2g} mJ{}: "
             "{:.2g}% is missing\n\n",
             "work of the muscle", millijoule * e.muscle, millijoule * e.pressure,
             e.base == 0.0 ? ""
                           : fmt::format(", of the moving base {:.4g} mJ", millijoule * e.base),
             millijoule * e.stored,
             e.kinetic == 0.0 && e.viscosity == 0.0
                 ? ""
                 : fmt::format(", in motion {:.2g} mJ, supports {:.2g} mJ, viscosity {:.2g} mJ",
                               millijoule * e.kinetic, millijoule * e.supports,
                               millijoule * e.viscosity),
             100.0 * e.error());
}

/// The wall free of stress and at every moment of the beat, a column each.
std::string shapes_text(const RunFacts& facts, const Results& r) {
  std::vector<std::pair<std::string, const VentricleShape*>> columns{
      {facts.unloaded ? "unloaded" : "early diast.", &r.early_diastole}};
  for (const auto& [moment, shape] : r.moments)
    columns.emplace_back(heartbeat::title(moment), &shape);
  std::size_t width = 0;
  for (const auto& column : columns)
    width = std::max(width, column.first.size() + 2);
  std::string text = fmt::format("  {:<34}", "");
  for (const auto& column : columns)
    text += fmt::format("{:>{}}", column.first, width);
  const auto row = [&](const char* what, double VentricleShape::*value, double unit) {
    text += fmt::format("\n  {:<34}", what);
    for (const auto& column : columns)
      text += fmt::format("{:>{}.2f}", column.second->*value / unit, width);
  };
  row("endocardial pressure (mmHg)", &VentricleShape::pressure, mmHg);
  row("cavity volume (ml)", &VentricleShape::cavity_volume, units::ml);
  row("wall volume (ml)", &VentricleShape::wall_volume, units::ml);
  row("endocardial apex z (mm)", &VentricleShape::apex_endo_z, 1.0);
  row("endocardial long axis (mm)", &VentricleShape::long_axis, 1.0);
  return text + "\n";
}

/// What heartbeats were fitted to.
std::string fitted_beats_text(const std::vector<FittedOfBeat>& fitted) {
  if (fitted.empty())
    return "";
  std::string text = fmt::format("  {:<34}{:>14}{:>14}{:>14}\n", "heartbeats fitted to", "measured",
                                 "fit", "last beat");
  for (const FittedOfBeat& v : fitted)
    text += fmt::format("  {:<34}{:>14.2f}{:>14.2f}{:>14.2f}  {}\n",
                        fmt::format("{} ({})", v.name, v.unit), v.measured, v.fit, v.beat,
                        v.within_tolerance ? "within tolerance" : "OUTSIDE TOLERANCE");
  return text + "\n";
}

Json pairs(const std::vector<std::pair<std::string, std::string>>& list) {
  Json json = Json::object();
  for (const auto& [name, value] : list)
    json[name] = value;
  return json;
}

std::string elements_of(const RunFacts& facts) {
  return fmt::format("{}{} elements", facts.elements, facts.order == 2 ? " quadratic" : "");
}

}  // namespace

std::string summary_json(const RunFacts& facts, const heartbeat::Beat& beat, const Results& r) {
  Json json;
  json["case"] = facts.case_name;
  json["program"] = {{"name", "ventricle"}, {"version", facts.version}, {"engine", facts.engine}};
  json["resolution"] = {{"grid", facts.grid.empty() ? Json() : Json(facts.grid)},
                        {"mesh_width_mm", number(facts.mesh_width)},
                        {"nodes", facts.nodes},
                        {"elements", facts.elements},
                        {"order", facts.order},
                        {"ranks", facts.ranks},
                        {"steps", beat.steps},
                        {"retries", beat.retries},
                        {"wall_clock_s", number(facts.wall_clock)}};
  json["early_diastole"] = shape_json(r.early_diastole);
  for (const auto& [moment, shape] : r.moments)
    json[moment] = shape_json(shape);
  json["edv_ml"] = number(1e-3 * r.at(heartbeat::end_diastole).cavity_volume);
  json["esv_ml"] = number(1e-3 * r.at(heartbeat::end_systole).cavity_volume);
  json["ejection_fraction_percent"] = number(100.0 * r.ejection_fraction());
  json["stroke_volume_ml"] = number(1e-3 * (r.at(heartbeat::end_diastole).cavity_volume -
                                            r.at(heartbeat::end_systole).cavity_volume));
  json["mass_g"] = number(1e3 * facts.muscle_density * r.early_diastole.wall_volume);
  add_ends(beat, json);
  json["strain"] =
      std::string(
          "Green-Lagrange; at end-systole relative to end-diastole, at end-diastole relative to ") +
      (facts.unloaded ? "the wall without load (named early_diastole)" : "early diastole");
  if (facts.unloaded)
    json["unloaded"] = unloaded_json(*facts.unloaded);
  json["whole_wall"] = region_json(r, "wall");
  if (has_zones(r))
    json["zones"] = zones_json(r);
  json["fibre_shortening_percent"] = number(100.0 * r.fibre_shortening);
  for (const auto& slice : r.rotation)
    json["rotation"].push_back(
        {{"slice", slice.slice},
         {"end_diastole_to_end_systole_deg", number(slice.from_end_diastole / degree)},
         {"early_diastole_to_end_systole_deg", number(slice.from_early_diastole / degree)}});
  add_fits(facts, json);
  if (facts.contractility)
    add_contractility(*facts.contractility, json);
  if (!facts.scar.empty())
    json["infarct"] = infarct_json(facts, r);
  for (const SegmentScar& s : facts.scar)
    json["infarct_segments"].push_back(
        {{"segment", s.name},
         {"infarct_ml", number(1e-3 * s.volume)},
         {"infarct_g", number(1e3 * s.mass)},
         {"percent_of_segment", number(100.0 * s.part)},
         {"transmurality_percent", number(100.0 * s.transmurality)}});
  add_remarks(facts, r, judge(facts, beat, r), json);
  json["parameters"] = pairs(facts.parameters);
  json["set_in_case_file"] = pairs(facts.origins);
  return json_text(json) + "\n";
}

std::string summary_text(const RunFacts& facts, const heartbeat::Beat& beat, const Results& r) {
  std::string text = fmt::format("{}: {}, {}, {} nodes{}, {} steps in {:.0f} s on {} rank{}\n\n",
                                 facts.case_name, facts.engine, elements_of(facts), facts.nodes,
                                 facts.grid.empty() ? "" : ", grid " + facts.grid, beat.steps,
                                 facts.wall_clock, facts.ranks, facts.ranks == 1 ? "" : "s");
  text += shapes_text(facts, r);
  text += fmt::format(
      "\n  ejection fraction {:.1f}%, mass {:.1f} g ({:g} g/ml)\n\n", 100.0 * r.ejection_fraction(),
      1e3 * facts.muscle_density * r.early_diastole.wall_volume, 1e6 * facts.muscle_density);
  text += beat.cycle ? cycle_text(beat)
                     : "  end-systole is where contraction ends, which need not be the least "
                       "volume of curves.csv\n\n";
  if (facts.unloaded)
    text += unloaded_text(*facts.unloaded);
  if (!facts.fitted.empty())
    text += fmt::format("  {:<34}{:>14}{:>14}{:>14}\n", "calibration (ml)", "measured",
                        "quasi-static", "this beat");
  for (const FittedVolume& v : facts.fitted)
    text += fmt::format("  {:<34}{:>14.2f}{:>14.2f}{:>14.2f}  {}\n", v.name, 1e-3 * v.measured,
                        1e-3 * v.quasi_static, 1e-3 * v.beat,
                        v.within_tolerance ? "within tolerance" : "OUTSIDE TOLERANCE");
  if (!facts.fitted.empty())
    text += "\n";
  text += fitted_beats_text(facts.fitted_beats);
  text += klotz_text(facts.klotz);
  text += fmt::format("  {:<34}{:>18}\n", "at end-systole, whole wall", "mean +- sd");
  for (const auto& v : r.regional)
    if (v.state == heartbeat::end_systole && v.scheme == "whole")
      text += fmt::format("  {:<34}{:>9.3f} +- {:.3f}{}\n", v.quantity, v.statistics.mean,
                          v.statistics.sd, v.unit == "1" ? "" : " " + v.unit);
  text += "\n";
  if (has_zones(r))
    text += zones_text(r);
  if (!facts.scar.empty())
    text += fmt::format("  {:<26}{:>9}{:>9}{:>14}{:>16}\n", "infarct per AHA segment", "ml", "g",
                        "of segment", "transmurality");
  for (const SegmentScar& scar : facts.scar)
    text +=
        fmt::format("  {:<26}{:>9.2f}{:>9.2f}{:>13.0f}%{:>15.0f}%\n", scar.name, 1e-3 * scar.volume,
                    1e3 * scar.mass, 100.0 * scar.part, 100.0 * scar.transmurality);
  if (!facts.scar.empty())
    text +=
        "  (the infarcted parts of elements; the zone \"infarct\" has the whole elements with M = "
        "1)\n"
        "\n";
  const std::vector<Judgement> judgements = judge(facts, beat, r);
  return text + plausibility_text(judgements) + remarks_text(facts, judgements);
}

}  // namespace lv::report
