#pragma once

#include "lv/analysis/results.hpp"
#include "lv/base/table.hpp"

namespace lv::report {

/// curves.csv: one row per recorded time, with units in the column names.
[[nodiscard]] Table curves_table(const std::vector<heartbeat::CurveRow>& curves);

/// regions.csv: one row per state, region and quantity: mean, standard deviation and percentiles.
[[nodiscard]] Table regions_table(const analysis::Results& results);

/// rotation.csv: one row per slice, in degrees, anticlockwise seen from the apex positive.
[[nodiscard]] Table rotation_table(const analysis::Results& results);

}  // namespace lv::report
