#include "lv/calibrate/record.hpp"

#include "lv/base/json_file.hpp"
#include "lv/base/units.hpp"

#include <algorithm>
#include <array>

namespace lv::calibrate {
namespace {

using Json = nlohmann::ordered_json;
using units::ml;
using units::mmHg;

const std::array<Fitted, 4>& all_parameters() {
  static const std::array<Fitted, 4> all{{{"C_a", &FitParameters::C_a},
                                          {"scale", &FitParameters::scale},
                                          {"exponent", &FitParameters::exponent},
                                          {"T_scale", &FitParameters::T_scale}}};
  return all;
}

std::vector<Fitted> fitted_in(const Json& uncertainty) {
  std::vector<Fitted> fitted;
  for (const Json& u : uncertainty)
    for (const Fitted& p : all_parameters())
      if (u.at("parameter") == p.name)
        fitted.push_back(p);
  return fitted;
}

RecordedVolume volume_in(const Json& json) {
  RecordedVolume v{json.at("name"),
                   json.at("pressure_mmHg").get<double>() * mmHg,
                   json.at("target_ml").get<double>() * ml,
                   json.at("model_ml").get<double>() * ml,
                   {}};
  for (const auto& [name, derivative] : json.at("dV_dparameter_ml").items())
    v.by_parameter[name] = derivative.get<double>() * ml;
  return v;
}

OtherPressure other_pressure_in(const Json& json, const std::vector<Fitted>& fitted,
                                const FitParameters& at) {
  OtherPressure other{json.at("pressure_mmHg").get<double>() * mmHg, {}, 0.0, ""};
  if (json.contains("no_fit")) {
    other.why_not = json.at("no_fit");
    return other;
  }
  other.parameters = at;
  for (const Fitted& p : fitted)
    (*other.parameters).*p.member = json.at(p.name).get<double>();
  other.unloaded_volume = json.at("unloaded_volume_ml").get<double>() * ml;
  return other;
}

}  // namespace

Json json_of(const FitParameters& p) {
  Json json;
  for (const Fitted& which : all_parameters())
    json[which.name] = p.*which.member;
  return json;
}

FitParameters parameters_in(const Json& json) {
  FitParameters p;
  for (const Fitted& which : all_parameters())
    p.*which.member = json.at(which.name).get<double>();
  return p;
}

FitParameters read_parameters(const std::filesystem::path& file) {
  return from_json_file(file,
                        [](const Json& json) { return parameters_in(json.at("parameters")); });
}

RecordedFit read_fit(const std::filesystem::path& file) {
  return from_json_file(file, [](const Json& json) {
    RecordedFit fit{
        parameters_in(json.at("parameters")), fitted_in(json.at("uncertainty")), {}, {}, {}};
    for (const Json& v : json.at("volumes"))
      fit.volumes.push_back(volume_in(v));
    if (json.contains("klotz")) {
      fit.klotz_pressure = json.at("klotz").at("pressure_mmHg").get<double>() * mmHg;
      for (const Json& other : json.at("other_pressures"))
        fit.other_pressures.push_back(other_pressure_in(other, fit.fitted, fit.parameters));
    }
    return fit;
  });
}

}  // namespace lv::calibrate
