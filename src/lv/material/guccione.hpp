#pragma once

#include "lv/material/tangent.hpp"

namespace lv::material {

/// Passive myocardium, transversely isotropic and exponential (Guccione, McCulloch & Waldman, J.
/// Biomech. Eng. 113:42-55, 1991), as the problems of Land et al. (Proc. R. Soc. A 471:20150641,
/// 2015) use it:
///
///   W(F) = C/2 (exp Q - 1),  Q = sum_ij b_ij E_ij^2  with E = (F^T F - 1)/2 in the fibre frame    [kPa]
///   P(F) = dW/dF = F S,      S_ij = C exp(Q) b_ij E_ij                                             [kPa]
///
/// b_ff = b_f; b_ss = b_nn = b_sn = b_t; b_fs = b_fn = b_fs. The second index of F and P is in the
/// fibre frame.
struct Guccione {
  double C = 2.0;     ///< [kPa]
  double b_f = 8.0;   ///< along the fibre [-]
  double b_t = 2.0;   ///< across the fibre [-]
  double b_fs = 4.0;  ///< fibre-cross-fibre shear [-]

  template <class T>
  [[nodiscard]] T energy(const Tensor<T>& F) const {
    using std::exp;
    return 0.5 * C * (exp(exponent(strain(F))) - 1.0);
  }

  template <class T>
  [[nodiscard]] Tensor<T> stress(const Tensor<T>& F) const {
    using std::exp;
    const Tensor<T> E = strain(F);
    const T C_exp_Q = C * exp(exponent(E));
    Tensor<T> S;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        S(i, j) = C_exp_Q * weight(i, j) * E(i, j);
    return F * S;
  }

  /// dP_ij/dF_kl = d_ik S_lj + F_im dS_mj/dF_kl [kPa].
  [[nodiscard]] Tangent<double> tangent(const Mat3& F) const;

 private:
  [[nodiscard]] double weight(int i, int j) const {
    if (i == 0 && j == 0)
      return b_f;
    return i == 0 || j == 0 ? b_fs : b_t;
  }

  /// Green-Lagrange strain.
  template <class T>
  [[nodiscard]] static Tensor<T> strain(const Tensor<T>& F) {
    Tensor<T> E = F.transpose() * F;
    for (int i = 0; i < 3; ++i)
      E(i, i) = E(i, i) - 1.0;
    return T(0.5) * E;
  }

  template <class T>
  [[nodiscard]] T exponent(const Tensor<T>& E) const {
    T Q(0.0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        Q = Q + weight(i, j) * E(i, j) * E(i, j);
    return Q;
  }
};

}  // namespace lv::material
