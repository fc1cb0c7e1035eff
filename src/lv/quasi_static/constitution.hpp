#pragma once

#include "lv/quasi_static/equations.hpp"

namespace lv::quasi_static {

/// Stress and, where asked for, tangent at one point, with the second index of F and P in the fibre
/// frame, and without the pressure's part.
struct Constitution {
  const Muscle& muscle;
  double activation;

  [[nodiscard]] Tension tension(const Mat3& F, double M) const {
    Tension T = muscle.contractility.at(F.col(0).norm(), activation);
    T.value *= muscle.material.infarct.active(M);
    T.derivative *= muscle.material.infarct.active(M);
    return T;
  }

  /// Of (2.18), with the infarct's stiffening (2.23).
  [[nodiscard]] Mat3 passive(const Mat3& F, double M) const {
    return muscle.material.infarct.passive(M) *
           std::visit([&](const auto& law) { return law.stress(F); }, muscle.material.passive);
  }

  /// Of (2.21), along F's first column.
  [[nodiscard]] Vec3 active_column(const Mat3& F, double tension) const {
    return material::active_stress_column(F, determinant(F), tension, muscle.material.active_form);
  }

  [[nodiscard]] Mat3 stress(const Mat3& F, double M) const {
    Mat3 P = passive(F, M);
    P.col(0) += active_column(F, tension(F, M).value);
    return P + muscle.stabilisation.stress(F);
  }

  [[nodiscard]] material::Tangent<double> tangent(const Mat3& F, double M) const {
    const Tension T = tension(F, M);
    return muscle.stabilisation.tangent(F) +
           muscle.material.infarct.passive(M) *
               std::visit([&](const auto& law) { return law.tangent(F); },
                          muscle.material.passive) +
           material::active_tangent(F, T.value, T.derivative, muscle.material.active_form);
  }
};

}  // namespace lv::quasi_static
