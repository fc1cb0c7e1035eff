#include "lv/calibrate/record.hpp"

namespace lv::calibrate {
namespace {

RecordedVolume recorded_volume(const Fit& fit, std::size_t k) {
  const ObservedVolume& o = fit.observations[k];
  RecordedVolume v{o.name, o.loads.pressure, o.target, fit.volumes[k], {}};
  const auto& parameters = fit.sensitivity.parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    v.by_parameter[parameters[j].name] =
        fit.volumes[k] *
        fit.sensitivity.by_parameter(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) /
        (fit.parameters.*parameters[j].member);
  return v;
}

}  // namespace

const std::array<Fitted, 4>& all_parameters() {
  static const std::array<Fitted, 4> all{{{"C_a", &FitParameters::C_a},
                                          {"scale", &FitParameters::scale},
                                          {"exponent", &FitParameters::exponent},
                                          {"T_scale", &FitParameters::T_scale}}};
  return all;
}

RecordedFit recorded(const Plan& plan, const Fit& fit) {
  RecordedFit record{fit.parameters, fit.sensitivity.parameters, {}, {}, {}};
  for (std::size_t k = 0; k < fit.observations.size(); ++k)
    record.volumes.push_back(recorded_volume(fit, k));
  if (plan.passive == FittedPassive::klotz) {
    record.klotz_pressure = plan.ed_pressure;
    record.other_pressures = fit.other_pressures;
  }
  record.segments = fit.segments;
  if (fit.regional_fit && fit.regional_fit->shape)
    record.shape = ShapeFit{{}, fit.regional_fit->shape->before, fit.regional_fit->shape->after};
  return record;
}

nlohmann::ordered_json json_of(const FitParameters& p) {
  nlohmann::ordered_json json;
  for (const Fitted& which : all_parameters())
    json[which.name] = p.*which.member;
  return json;
}

}  // namespace lv::calibrate
