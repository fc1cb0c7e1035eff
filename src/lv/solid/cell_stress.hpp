#pragma once

#include "lv/base/tensor.hpp"

#include <span>

namespace lv::solid {

/// Stresses at a point, or means over one linear cell of a mesh, weighted by reference volume.
struct CellStress {
  double tension = 0.0;                ///< T, with the infarct's factor [kPa]
  double pressure = 0.0;               ///< p of (2.6) [kPa]
  Mat3 cauchy_passive = Mat3::Zero();  ///< of (2.19), without -p [kPa]
  Mat3 cauchy_active = Mat3::Zero();   ///< of (2.22) [kPa]
  /// Along the deformed fibre, f.sigma f with f = F f0/|F f0| [kPa].
  double fibre_stress_passive = 0.0, fibre_stress_active = 0.0;

  static constexpr int numbers = 22;  ///< doubles in it, one after the other
  [[nodiscard]] std::span<double> as_numbers() { return {&tension, numbers}; }

  /// Adds `weight` times another one.
  void add(double weight, CellStress other) {
    for (int i = 0; i < numbers; ++i)
      as_numbers()[i] += weight * other.as_numbers()[i];
  }
};
static_assert(sizeof(CellStress) == CellStress::numbers * sizeof(double));

/// The stresses that a material::PointLaw makes of F and the tension of muscle without an infarct.
/// F has its second index in the fibre frame, so
/// that sigma = P F^T / J and f = F f0 is its first column. Its volumetric part, which is
/// spherical, is given as a pressure.
template <class PointLaw>
CellStress point_stress(const PointLaw& law, const Mat3& F, double tension, double M) {
  const double J = determinant(F);
  const Vec3 f = F.col(0).normalized();
  CellStress s;
  s.tension = law.tension_left(tension, M);
  s.pressure = -(law.volumetric.stress(F) * F.transpose()).trace() / (3.0 * J);
  s.cauchy_passive = law.passive(F, M) * F.transpose() / J;
  s.cauchy_active = law.active(F, J, tension, M) * F.col(0).transpose() / J;
  s.fibre_stress_passive = f.dot(s.cauchy_passive * f);
  s.fibre_stress_active = f.dot(s.cauchy_active * f);
  return s;
}

}  // namespace lv::solid
