#pragma once

#include "lv/base/table.hpp"
#include "lv/circulation/family.hpp"
#include "lv/drawing/figure.hpp"

#include <span>
#include <string>

/// Table, figure and words of heartbeats under several loads.
namespace lv::report {

/// study.csv, a row per beat: its factors, its measures as in beats.csv, its point on the
/// end-systolic relation, and the lines of its contractility and heart rate.
[[nodiscard]] Table study_table(std::span<const circulation::Contractility> family);

/// Loops with the end-systolic relations, and stroke work against end-diastolic volume with the
/// lines of preload-recruitable stroke work; a colour per contractility and heart rate.
[[nodiscard]] drawing::Figure study_figure(std::span<const circulation::Contractility> family);

/// The lines with their units.
[[nodiscard]] std::string study_text(std::span<const circulation::Contractility> family);

}  // namespace lv::report
