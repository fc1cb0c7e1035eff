#pragma once

#include "lv/mesh/wall_mesh.hpp"

#include <optional>
#include <string>

namespace lv::anatomy {

/// V / A [mm] of a wall of the volume V [mm^3], with the area A of the surface in its middle: the
/// mean thickness, but for a twelfth of (thickness / radius of curvature)^2 of it.
[[nodiscard]] double mean_thickness(const mesh::WallMap& wall, double volume);

/// A sentence that names what of a wall no human left ventricle has, at any moment of its beat;
/// empty if it may be one. Volumes [mm^3], the mean thickness [mm] where it was measured. The
/// ranges are wide, for they shall find a wrong voxel size or unit, not a disease:
///
///   cavity     20 to 600 ml   end-systole of small healthy women (44 - 2 x 11 ml) to nearly three
///                             times the end-diastole of large healthy men (160 + 2 x 27 ml)
///   wall       40 to 600 ml   three quarters of light healthy walls (98 - 2 x 21 g of 1.05 g/ml) to
///                             three and a half times heavy ones (134 + 2 x 21 g)
///   thickness  3 to 30 mm     that of the lightest of these walls round the largest cavity, as
///                             spheres, to extreme hypertrophy's at its thickest (P. Spirito et al.,
///                             N. Engl. J. Med. 342:1778, 2000)
///
/// Volumes and masses: N. Kawel-Boehm et al., J. Cardiovasc. Magn. Reson. 17:29, 2015.
[[nodiscard]] std::string odd_size(double cavity, double wall, std::optional<double> thickness);

}  // namespace lv::anatomy
