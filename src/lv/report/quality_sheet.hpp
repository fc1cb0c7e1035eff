#pragma once

#include "lv/base/table.hpp"
#include "lv/geometry/fit_report.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lv::report {

/// How well the fitted wall shows what was drawn or labelled.
struct QualitySheet {
  geometry::FitReport fit;
  std::string source;                                ///< "labels, frame 1", for the head
  std::string base_rule;                             ///< where the base plane was laid, in words
  std::optional<double> label_cavity, label_muscle;  ///< volumes of voxels [mm^3]
  std::vector<std::string> notes;                    ///< what was assumed, filled, left out
};

/// One row per figure: quantity, slice, value, unit.
[[nodiscard]] Table quality_table(const QualitySheet& sheet);

/// The same for programs: one object.
[[nodiscard]] std::string quality_json(const QualitySheet& sheet);

/// The same for a terminal.
[[nodiscard]] std::string quality_text(const QualitySheet& sheet);

}  // namespace lv::report
