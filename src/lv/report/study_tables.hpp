#pragma once

#include "lv/base/table.hpp"
#include "lv/circulation/family.hpp"
#include "lv/drawing/figure.hpp"

#include <span>
#include <string>

/// Table, figure and words of heartbeats under several loads.
namespace lv::report {

/// study.csv, a row per beat: its factors, its measures as in beats.csv, its point on the
/// end-systolic relation, and the lines of its contractility and heart rate; then the cases without
/// a beat, which have nothing but their factors and why.
[[nodiscard]] Table study_table(std::span<const circulation::Contractility> family,
                                std::span<const circulation::MissingBeat> missing = {});

/// Loops with the end-systolic relations, and stroke work against end-diastolic volume with the
/// lines of preload-recruitable stroke work; a colour per contractility and heart rate;
/// beats that are no limit cycles are triangles, and a footnote counts them.
[[nodiscard]] drawing::Figure study_figure(std::span<const circulation::Contractility> family);

/// The lines with their units, which of their beats are no limit cycles, and which cases have no
/// beat.
[[nodiscard]] std::string study_text(std::span<const circulation::Contractility> family,
                                     std::span<const circulation::MissingBeat> missing = {});

}  // namespace lv::report
