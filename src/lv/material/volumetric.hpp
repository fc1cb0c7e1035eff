#pragma once

#include "lv/material/tangent.hpp"

namespace lv::material {

/// The penalty that reinforces incompressibility in Lagrangian form (2.20):
///
///   U(F) = beta_s (ln J)^2                                               [kPa]
///   P(F) = dU/dF = beta_s log(I3) F^{-T},  I3 = det C = J^2              [kPa]
struct Volumetric {
  double beta_s = 1000.0;  ///< [kPa]; the paper: 1.0e6 dyn/cm^2 = 100 kPa, see docs/method.md

  template <class T>
  [[nodiscard]] T energy(const Tensor<T>& F) const {
    using std::log;
    const T log_J = log(determinant(F));
    return beta_s * log_J * log_J;
  }

  /// dU/dJ = 2 beta_s ln J / J, a tension [kPa].
  template <class T>
  [[nodiscard]] T tension(const T& J) const {
    using std::log;
    return 2.0 * beta_s * log(J) / J;
  }

  template <class T>
  [[nodiscard]] Tensor<T> stress(const Tensor<T>& F) const {
    const Tensor<T> cof = cofactor(F);
    const T J = F.col(0).dot(cof.col(0));
    return tension(J) * cof;
  }

  /// dP/dF = 2 beta_s/J [(1 - ln J)/J cof F (x) cof F + ln J d cof(F)/dF]   [kPa]
  [[nodiscard]] Tangent<double> tangent(const Mat3& F) const;
};

}  // namespace lv::material
