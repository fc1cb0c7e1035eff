#pragma once

#include "lv/calibrate/fit.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lv::calibrate {

/// A volume that a fit was asked for, and what it came to.
struct RecordedVolume {
  std::string name;                            ///< EDV, ESV, or a point of Klotz's curve
  double pressure;                             ///< [kPa]
  double target, model;                        ///< [mm^3]
  std::map<std::string, double> by_parameter;  ///< dV/dx of the fitted ones [mm^3]
};

/// Of a fit, what later stages need.
struct RecordedFit {
  FitParameters parameters;
  std::vector<Fitted> fitted;  ///< the parameters that were
  std::vector<RecordedVolume> volumes;
  std::optional<double> klotz_pressure;        ///< of a fit to Klotz's curve [kPa]
  std::vector<OtherPressure> other_pressures;  ///< the same fit for them
  std::vector<FittedSegment> segments = {};    ///< see Fit
  std::optional<ShapeFit> shape = {};          ///< without the single distances
};

[[nodiscard]] RecordedFit recorded(const Plan& plan, const Fit& fit);

/// All numbers of the whole wall that a calibration may change, with their names.
[[nodiscard]] const std::array<Fitted, 4>& all_parameters();

/// As JSON: {"C_a": ..., "scale": ..., "exponent": ..., "T_scale": ...}.
[[nodiscard]] nlohmann::ordered_json json_of(const FitParameters& p);

}  // namespace lv::calibrate
