#pragma once

#include "lv/analysis/regional.hpp"

#include <array>
#include <vector>

namespace lv::analysis {

/// Size and shape of the ventricle at one time.
struct VentricleShape {
  double time = 0.0;              ///< [s]
  double pressure = 0.0;          ///< on the endocardium [kPa]
  double cavity_volume = 0.0;     ///< [mm^3]
  double wall_volume = 0.0;       ///< [mm^3]
  double apex_endo_z = 0.0;       ///< lowest point of the endocardium [mm]
  double apex_epi_z = 0.0;        ///< [mm]
  double base_endo_radius = 0.0;  ///< mean distance of the endocardial edge from its centre [mm]
  double base_axial_shift = 0.0;  ///< largest axial displacement of the basal nodes [mm]
};

/// A quantity's statistics in one region at one state.
struct RegionalValue {
  std::string state;   ///< end_diastole or end_systole
  std::string scheme;  ///< of the region
  std::string region;
  std::string quantity;
  std::string unit;
  double volume;  ///< of the region, undeformed [mm^3]
  Statistics statistics;
};

/// Mean rotation of a slice [rad], anticlockwise seen from the apex positive.
struct SliceRotation {
  int slice;
  double from_end_diastole;    ///< to end-systole
  double from_early_diastole;  ///< to end-systole
  double filling;              ///< early diastole to end-diastole
};

/// All numbers of a beat, computed from its three states.
struct Results {
  VentricleShape early_diastole, end_diastole, end_systole;
  std::vector<RegionalValue> regional;
  std::vector<SliceRotation> rotation;
  Statistics J_end_diastole{}, J_end_systole{};
  double fibre_shortening = 0.0;  ///< mean of 1 - lambda_ES/lambda_ED
  double thickening =
      0.0;  ///< mean stretch of the wall's thickness from end-diastole to end-systole, minus 1

  [[nodiscard]] double ejection_fraction() const {
    return 1.0 - end_systole.cavity_volume / end_diastole.cavity_volume;
  }
  /// The statistics of a quantity over the whole wall.
  [[nodiscard]] const Statistics& whole(const std::string& state,
                                        const std::string& quantity) const;
};

/// The elements' fields at the three states of a beat.
struct BeatFields {
  std::vector<CellFields> early_diastole, end_diastole, end_systole;
};

[[nodiscard]] Results results(const mesh::Mesh& mesh, const mesh::Regions& regions,
                              const heartbeat::Beat& beat, const BeatFields& fields);

}  // namespace lv::analysis
