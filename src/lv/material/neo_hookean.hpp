#pragma once

#include "lv/material/tangent.hpp"

namespace lv::material {

/// The simplest rubber, for problems with exact solutions:
///
///   W(F) = mu/2 (I1 - 3) - mu ln J                         [kPa]
///   P(F) = dW/dF = mu (F - F^{-T}): no stress at rest      [kPa]
struct NeoHookean {
  double mu = 1.0;  ///< shear modulus [kPa]

  template <class T>
  [[nodiscard]] T energy(const Tensor<T>& F) const {
    using std::log;
    return 0.5 * mu * (F.squaredNorm() - 3.0) - mu * log(determinant(F));
  }

  template <class T>
  [[nodiscard]] Tensor<T> stress(const Tensor<T>& F) const {
    const Tensor<T> cof = cofactor(F);
    const T J = F.col(0).dot(cof.col(0));
    return T(mu) * F - (T(mu) / J) * cof;
  }

  /// dP/dF [kPa].
  [[nodiscard]] Tangent<double> tangent(const Mat3& F) const;
};

}  // namespace lv::material
