#pragma once

#include "lv/anatomy/mesh_result.hpp"
#include "lv/base/units.hpp"
#include "lv/case_file/case.hpp"

#include <string>

namespace lv::beating_wall {

/// What a patient's left ventricle is filled with in the worst failure; validate warns of more
/// [kPa].
inline constexpr double worst_filling = 40.0 * units::mmHg;

/// The pressure beyond which no ventricle is filled: half as much again [kPa].
inline constexpr double most_of_any_filling = 1.5 * worst_filling;

/// A wall without any tension that was filled until it held a volume, or as far as it may be.
struct FilledWall {
  double pressure = 0.0;  ///< [kPa]
  double volume = 0.0;    ///< of the cavity [mm^3]
  std::string why_ended;  ///< before either, where the next had no equilibrium; else empty
};

/// Fills the undeformed wall by doubling its pressure, until it holds `volume` or bears `most`
/// [mm^3, kPa]. Collective.
[[nodiscard]] FilledWall fill_until(double volume, double most, const case_file::Case& c,
                                    const mesh::Mesh& mesh);

/// Throws InputError for a measured end-diastolic volume to which a fit of heartbeats cannot fill
/// this wall, by more than calibrate::reach_margin; warns of less, and where the wall's filling
/// does not bound that of its beats. Tension only keeps a wall from filling, and the mitral valve
/// closes where the pressure comes to that before it: beats hold no more than the wall without
/// tension under the largest pressure before the valve, which is the fit's largest of a windkessel,
/// and no more than any ventricle's. Takes seconds. Collective.
void check_filling(const case_file::Case& c, const anatomy::MeshResult& wall);

}  // namespace lv::beating_wall
