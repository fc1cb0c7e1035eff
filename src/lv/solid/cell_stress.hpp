#pragma once

#include "lv/base/tensor.hpp"

namespace lv::solid {

/// Means over one linear cell of a mesh, weighted by reference volume.
struct CellStress {
  double tension = 0.0;                ///< T, with the infarct's factor [kPa]
  double pressure = 0.0;               ///< p of (2.6) [kPa]
  Mat3 cauchy_passive = Mat3::Zero();  ///< of (2.19), without -p [kPa]
  Mat3 cauchy_active = Mat3::Zero();   ///< of (2.22) [kPa]
  /// Along the deformed fibre, f.sigma f with f = F f0/|F f0| [kPa].
  double fibre_stress_passive = 0.0, fibre_stress_active = 0.0;

  static constexpr int numbers = 22;  ///< doubles in it, one after the other
};
static_assert(sizeof(CellStress) == CellStress::numbers * sizeof(double));

}  // namespace lv::solid
