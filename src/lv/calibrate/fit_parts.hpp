#pragma once

#include "lv/calibrate/fit.hpp"

#include <string>
#include <vector>

namespace lv::calibrate {

// names of a fit's parts
inline constexpr const char* of_filling = "filling";
inline constexpr const char* of_unloaded = "unloaded volume";
inline constexpr const char* of_first_tension = "first T_scale";
inline constexpr const char* of_curve = "fit to the Klotz curve";
inline constexpr const char* of_regions = "least squares";
inline constexpr const char* of_result = "result";
inline constexpr const char* of_sensitivity = "sensitivity";

[[nodiscard]] inline std::string bracket_of(const std::string& parameter) {
  return "bracket of " + parameter;
}

/// The parts of a fit in their order, with the equilibria that each usually takes.
[[nodiscard]] std::vector<FitPart> parts_of(const Plan& plan);

}  // namespace lv::calibrate
