#pragma once

#include "lv/analysis/results.hpp"
#include "lv/base/table.hpp"
#include "lv/geometry/fit_report.hpp"
#include "lv/material/stress_stretch.hpp"
#include "lv/mesh/quality.hpp"

namespace lv::report {

/// curves.csv: one row per recorded time, with units in the column names.
[[nodiscard]] Table curves_table(const std::vector<heartbeat::CurveRow>& curves);

/// moments.csv: one row per moment that the beat has come to, with the phase that it ends.
[[nodiscard]] Table moments_table(const std::vector<heartbeat::NamedMoment>& moments);

/// regions.csv: one row per state, region and quantity: mean, standard deviation and percentiles.
[[nodiscard]] Table regions_table(const analysis::Results& results);

/// rotation.csv: one row per slice, in degrees, anticlockwise seen from the apex positive.
[[nodiscard]] Table rotation_table(const analysis::Results& results);

/// stress_stretch.csv: one row per point of the curves, muscle after muscle.
[[nodiscard]] Table stress_stretch_table(const std::vector<material::StressStretch>& curves);

/// quality.csv: the mesh's figures, one per row, the worst element named.
[[nodiscard]] Table quality_table(const mesh::Quality& quality);

/// fit.csv: per image and surface the distances of the contours' points from the fitted surface and
/// how far the slice was moved.
[[nodiscard]] Table fit_table(const geometry::FitReport& fit);

}  // namespace lv::report
