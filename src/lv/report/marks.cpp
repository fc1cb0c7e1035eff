#include "lv/report/marks.hpp"

#include "lv/base/check.hpp"
#include "lv/report/summary.hpp"

#include <algorithm>

namespace lv::report {
namespace {

using Marks = std::vector<std::pair<std::string, Mark>>;

/// A heartbeat has the pressures that its circulation makes, not those of the fit.
bool was_fitted(const RunFacts& facts, const char* volume) {
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
  for (const char* figure : {"mass_g", "whole_wall", "zones", "fibre_shortening_percent",
                             "rotation", "plausibility", "calibration.beat_ml", "cycle"})
    all.emplace_back(figure, Mark::computed);
  all.insert(all.end(),
             {{"calibration.measured_ml", Mark::measured},
              {"calibration.quasi_static_ml", Mark::fitted},
              {"klotz", Mark::assumed},
              {"klotz.model_ml", Mark::fitted},
              {"infarct", facts.scar_is_measured ? Mark::measured : Mark::assumed},
              {"infarct_segments", facts.scar_is_measured ? Mark::measured : Mark::assumed},
              {"unloaded", Mark::computed},
              {"unloaded.seen_under_mmHg", Mark::assumed},
              {"unloaded.seen_volume_ml", facts.shape}});
  mark_parameters(facts, all);
  return all;
}

}  // namespace lv::report
