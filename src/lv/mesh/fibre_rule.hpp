#pragma once

namespace lv::mesh {

/// Rule-based fibres (section 2.2; Potse et al., IEEE Trans. Biomed. Eng. 53:2425, 2006). Angles in
/// radians.
///
/// The helix angle grows linearly through the wall from `helix_endo` to `helix_epi`. It is the
/// paper's angle: from -60 degrees at the endocardium to +60 at the epicardium, positive when the
/// fibre, followed anticlockwise as seen from the base, goes down towards the apex. So -60 at the
/// endocardium is a right-handed helix there, as in every human heart, and the apex turns
/// anticlockwise as seen from the apex in systole. LDRB tools use the opposite sign.
///
///   f0 = cos(helix) c - sin(helix) l
///   s0 = the part normal to f0 of  cos(sheet) r + sin(sheet) l,  normalised;   n0 = f0 x s0
struct FibreRule {
  double helix_endo = -1.0471975511965976;  ///< -60 degrees
  double helix_epi = 1.0471975511965976;    ///< +60 degrees
  double sheet_endo = -0.7853981633974483;  ///< -45 degrees
  double sheet_epi = 0.7853981633974483;    ///< +45 degrees
};

}  // namespace lv::mesh
