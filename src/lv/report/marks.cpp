#include "lv/report/marks.hpp"

#include "lv/base/check.hpp"
#include "lv/report/summary.hpp"

#include <algorithm>
#include <array>

namespace lv::report {
namespace {

using Marks = std::vector<std::pair<std::string, Mark>>;

bool beats_were_fitted(const RunFacts& facts, const char* datum) {
  return std::any_of(facts.fitted_beats.begin(), facts.fitted_beats.end(),
                     [&](const FittedOfBeat& v) { return v.name == datum; });
}

/// A heartbeat has the pressures that its circulation makes, not those of a fit before it.
bool was_fitted(const RunFacts& facts, const char* volume) {
  if (beats_were_fitted(facts, volume))
    return true;
  return facts.pressure != Mark::computed &&
         std::any_of(facts.fitted.begin(), facts.fitted.end(),
                     [&](const FittedVolume& v) { return v.name == volume; });
}

/// Volumes that parameters were fitted to are no predictions.
void mark_volumes(const RunFacts& facts, Marks& marks) {
  const auto mark = [&](bool fitted) { return fitted ? Mark::fitted : Mark::computed; };
  const bool edv = was_fitted(facts, "EDV");
  const bool esv = was_fitted(facts, "ESV");
  marks.insert(marks.end(), {{"edv_ml", mark(edv)},
                             {"end_diastole.cavity_volume_ml", mark(edv)},
                             {"esv_ml", mark(esv)},
                             {"end_systole.cavity_volume_ml", mark(esv)},
                             {"stroke_volume_ml", mark(edv && esv)},
                             {"ejection_fraction_percent", mark(edv && esv)}});
}

/// What heartbeats were fitted to, where the last of them is told of.
void mark_beats(const RunFacts& facts, Marks& marks) {
  constexpr std::array<std::pair<const char*, const char*>, 4> told{
      {{"EDV", "edv_ml"},
       {"ESV", "esv_ml"},
       {"systolic", "aortic_systolic_mmHg"},
       {"diastolic", "aortic_diastolic_mmHg"}}};
  for (const auto& [datum, name] : told)
    if (beats_were_fitted(facts, datum))
      marks.emplace_back(std::string("cycle.last_beat.") + name, Mark::fitted);
}

void mark_parameters(const RunFacts& facts, Marks& marks) {
  const auto has = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  marks.emplace_back("parameters", Mark::assumed);
  for (const auto& [name, value] : facts.parameters)
    if (has(facts.fitted_parameters, name))
      marks.emplace_back("parameters." + name, Mark::fitted);
    else if (has(facts.measured_parameters, name))
      marks.emplace_back("parameters." + name, Mark::measured);
}

}  // namespace

std::string name(Mark mark) {
  switch (mark) {
    case Mark::measured:
      return "measured";
    case Mark::fitted:
      return "fitted";
    case Mark::assumed:
      return "assumed";
    case Mark::computed:
      return "computed";
  }
  LV_CHECK(false);
}

Marks marks(const RunFacts& facts, const std::vector<std::string>& moments) {
  Marks all{{"early_diastole", facts.unloaded ? Mark::computed : facts.shape},
            {"early_diastole.pressure_mmHg", Mark::assumed}};
  for (const std::string& moment : moments)
    all.insert(all.end(), {{moment, Mark::computed}, {moment + ".pressure_mmHg", facts.pressure}});
  mark_volumes(facts, all);
  // the mass is the shape's volume times a density, which no beat changes
  all.emplace_back("mass_g", facts.shape == Mark::assumed ? Mark::assumed : Mark::computed);
  for (const char* figure : {"whole_wall", "zones", "fibre_shortening_percent", "rotation",
                             "plausibility", "calibration.beat_ml", "cycle"})
    all.emplace_back(figure, Mark::computed);
  all.insert(all.end(),
             {{"calibration.measured_ml", Mark::measured},
              {"calibration.quasi_static_ml", Mark::fitted},
              {"klotz", Mark::assumed},
              {"klotz.model_ml", Mark::fitted},
              {"contractility", Mark::fitted},
              {"shape_fitted", Mark::fitted},
              {"infarct", facts.scar_is_measured ? Mark::measured : Mark::assumed},
              {"infarct_segments", facts.scar_is_measured ? Mark::measured : Mark::assumed},
              {"unloaded", Mark::computed},
              {"unloaded.seen_under_mmHg", Mark::assumed},
              {"unloaded.seen_volume_ml", facts.shape}});
  if (!facts.fitted_beats.empty())
    all.insert(all.end(), {{"heartbeats_fitted", Mark::fitted},
                           {"heartbeats_fitted.measured", Mark::measured}});
  mark_beats(facts, all);
  mark_parameters(facts, all);
  return all;
}

}  // namespace lv::report
