#pragma once

#include "lv/base/table.hpp"
#include "lv/report/figure.hpp"

#include <filesystem>
#include <string>

namespace lv::report {

/// Pressure, volume and mean active tension against time, and pressure against volume, from
/// curves.csv.
[[nodiscard]] Figure curves_figure(const Table& curves);

/// Calcium against time, from curves.csv.
[[nodiscard]] Figure calcium_figure(const Table& curves);

/// Fibre strain, fibre stress, active tension and radial strain at end-systole in the 17 segments,
/// from regions.csv.
[[nodiscard]] Figure segments_figure(const Table& regions);

/// A quantity's regional means at a state in the paper's seven slices and in the 17 segments, from
/// regions.csv. Strains have a scale that is symmetric about 0, J one about 1.
[[nodiscard]] Figure bulls_eyes_figure(const Table& regions, const std::string& quantity,
                                       const std::string& state);

/// Rotation of the slices, from rotation.csv.
[[nodiscard]] Figure rotation_figure(const Table& rotation);

/// Stress against stretch of the case's passive muscle and of published ones, from
/// stress_stretch.csv.
[[nodiscard]] Figure muscle_figure(const Table& curves);

/// Strain of the model against that from images, and their difference against their mean with bias
/// and 95% limits of agreement (Bland & Altman, Lancet 327:307, 1986), of the pairs of one scheme
/// in strain_comparison_COMPONENT.csv.
[[nodiscard]] Figure agreement_figure(const Table& pairs, const std::string& component,
                                      const std::string& scheme);

/// Writes every chart and bull's-eye of a work folder as SVG into `folder`, and nothing for what is
/// missing. Throws RunError naming a file that cannot be written.
void write_figures(const std::filesystem::path& work, const std::filesystem::path& folder);

}  // namespace lv::report
