#pragma once

#include "lv/base/check.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace lv {

/// The stages of a run in their order, as in case_file::Stage.
inline const std::array<std::string, 9> stage_names{
    "circulation", "strain", "anatomy", "mesh", "calibrate", "unload", "beat", "results", "report"};

/// Its folder in a work folder: "00_circulation", "00_strain", "02b_calibrate" and "02c_unload"
/// (only of cases that ask for them), "01_anatomy", "02_mesh", "03_beat", ...
[[nodiscard]] inline std::string stage_folder(std::size_t stage) {
  static constexpr std::array<const char*, 9> numbers{"00",  "00", "01", "02", "02b",
                                                      "02c", "03", "04", "05"};
  return std::string(numbers.at(stage)) + "_" + stage_names.at(stage);
}
[[nodiscard]] inline std::string stage_folder(std::string_view name) {
  const auto* found = std::find(stage_names.begin(), stage_names.end(), name);
  LV_CHECK(found != stage_names.end());
  return stage_folder(static_cast<std::size_t>(found - stage_names.begin()));
}

}  // namespace lv
