#pragma once

#include "lv/phantom/imaging.hpp"
#include "lv/strain/segments.hpp"

#include <array>
#include <string>
#include <vector>

namespace lv::phantom {

/// What is known of a study without error, by formula or by differentiating the motion.
struct Truth {
  std::vector<double> times;                                  ///< of the phases [s]
  std::vector<double> cavity_volumes;                         ///< [mm^3]
  int end_diastole = 1, end_systole = 1, early_diastole = 1;  ///< phases, counted from 1
  double wall_volume = 0.0;                                   ///< [mm^3]
  double scar_volume = 0.0;                                   ///< [mm^3]
  std::array<double, 17> scar_of_segment{};                   ///< AHA [mm^3]
  /// The muscle that lies in the middle of each drawn short-axis slice at end-diastole, which the
  /// motion of the base carries through the slice's plane.
  std::vector<strain::SliceSeries> slices;
  std::vector<strain::SegmentStrain> segments;  ///< of the slices; AHA's from the whole wall
};

[[nodiscard]] Truth truth(const Ventricle& ventricle, const Scan& scan, const ScanPlanes& planes);

/// Phase times as fractions of the cycle.
[[nodiscard]] std::vector<double> phase_times(const Scan& scan);

/// truth.json
[[nodiscard]] std::string truth_json(const Truth& truth, const Ventricle& ventricle,
                                     const Scan& scan, const ScanPlanes& planes);

}  // namespace lv::phantom
