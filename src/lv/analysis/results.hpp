#pragma once

#include "lv/analysis/regional.hpp"
#include "lv/heartbeat/beat.hpp"

#include <string>
#include <utility>
#include <vector>

namespace lv::analysis {

/// Size and shape of the ventricle at one time.
struct VentricleShape {
  double time = 0.0;           ///< [s]
  double pressure = 0.0;       ///< on the endocardium [kPa]
  double cavity_volume = 0.0;  ///< [mm^3]
  double wall_volume = 0.0;    ///< [mm^3]
  double apex_endo_z = 0.0;    ///< lowest point of the endocardium [mm]
  double apex_epi_z = 0.0;     ///< [mm]
  double long_axis = 0.0;      ///< from the middle of the endocardium's edge to its farthest node,
                               ///< the apex [mm]
  double base_endo_radius = 0.0;  ///< mean distance of the endocardial edge from its centre [mm]
  double base_axial_shift = 0.0;  ///< largest axial displacement of the basal nodes [mm]
};

/// A quantity's statistics in one region at one state.
struct RegionalValue {
  std::string state;   ///< name of the moment
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

/// The elements' fields at rest and at the moments of a beat.
struct BeatFields {
  struct Moment {
    std::string name;
    std::vector<CellFields> cells;
  };
  std::vector<CellFields> early_diastole;
  std::vector<Moment> moments;

  [[nodiscard]] const std::vector<CellFields>& at(const std::string& moment) const;
};

/// All numbers of a beat.
struct Results {
  VentricleShape early_diastole;
  std::vector<std::pair<std::string, VentricleShape>> moments;  ///< name and shape, in their order
  std::vector<RegionalValue> regional;
  std::vector<SliceRotation> rotation;
  double fibre_shortening = 0.0;  ///< mean of 1 - lambda_ES/lambda_ED
  double thickening =
      0.0;  ///< mean stretch of the wall's thickness from end-diastole to end-systole, minus 1

  [[nodiscard]] const VentricleShape& at(const std::string& moment) const;
  [[nodiscard]] double ejection_fraction() const {
    return 1.0 -
           at(heartbeat::end_systole).cavity_volume / at(heartbeat::end_diastole).cavity_volume;
  }
  /// The statistics of a quantity over the whole wall.
  [[nodiscard]] const Statistics& whole(const std::string& moment,
                                        const std::string& quantity) const;
};

[[nodiscard]] Results results(const mesh::Mesh& mesh, const mesh::Regions& regions,
                              const heartbeat::Beat& beat, const BeatFields& fields);

}  // namespace lv::analysis
