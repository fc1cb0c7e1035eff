#pragma once

#include "lv/base/table.hpp"
#include "lv/drawing/figure.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lv::report {

/// What curves.csv does not say of itself.
struct CurveFacts {
  bool is_static = false;   ///< equilibria: the times are no times but shares of the loads
  bool has_valves = false;  ///< it is a heartbeat of a circulation
  std::vector<std::pair<std::string, double>> moments;  ///< names and times [s]
};

/// Pressure, volume and mean active tension against time (against the load where there is no time),
/// each with an axis of its own, and pressure against volume with the moments marked, from
/// curves.csv.
[[nodiscard]] drawing::Figure curves_figure(const Table& curves, const CurveFacts& facts);

/// Calcium in the same way; nothing where it is missing throughout. Missing values are gaps.
[[nodiscard]] std::optional<drawing::Figure> calcium_figure(const Table& curves,
                                                            const CurveFacts& facts);

/// Fibre strain, fibre stress, active tension and radial strain at end-systole in the 17 segments,
/// from regions.csv. Names of walls have a star where the septum is assumed.
[[nodiscard]] drawing::Figure segments_figure(const Table& regions,
                                              const drawing::Orientation& orientation);

/// A quantity's regional means at a state in the paper's seven slices and in the 17 segments, from
/// regions.csv, by the scale of both states. Strains have a scale that is symmetric about 0, J one
/// about 1; what is below the quantity's floor has no colour.
[[nodiscard]] drawing::Figure bulls_eyes_figure(const Table& regions, const std::string& quantity,
                                                const std::string& state,
                                                const drawing::Orientation& orientation);

/// Factors of contractility in the 17 segments, fitted from strain, and the standard errors of
/// their logarithms, from contractility.csv.
[[nodiscard]] drawing::Figure contractility_figure(const Table& segments,
                                                   const drawing::Orientation& orientation);

/// Rotation of the slices, from rotation.csv.
[[nodiscard]] drawing::Figure rotation_figure(const Table& rotation,
                                              const drawing::Orientation& orientation);

/// Stress against stretch of the case's passive muscle and of excised muscle, from
/// stress_stretch.csv; the paper's subjects are left out.
[[nodiscard]] drawing::Figure muscle_figure(const Table& curves);

/// Strain of the model against that from images, and their difference against their mean with bias
/// and 95% limits of agreement (Bland & Altman, Lancet 327:307, 1986), of the pairs of one scheme
/// in strain_comparison_COMPONENT.csv.
[[nodiscard]] drawing::Figure agreement_figure(const Table& table, const std::string& component,
                                               const std::string& scheme,
                                               const drawing::Orientation& orientation);

/// Writes every chart and bull's-eye of a work folder as SVG into `folder`, and nothing for what is
/// missing. Throws RunError naming a file that cannot be written.
void write_figures(const std::filesystem::path& work, const std::filesystem::path& folder);

}  // namespace lv::report
