#pragma once

#include "lv/material/tangent.hpp"

namespace lv::material {

/// Passive myocardium, orthotropic (Holzapfel & Ogden, Phil. Trans. R. Soc. A 367:3445-3475, 2009),
/// as in the paper:
///
///   W(F) = a/2b exp[b(I1-3)] + sum_{i=f,s} a_i/2b_i {exp[b_i (I4i*-1)^2] - 1}
///          + a_fs/2b_fs {exp[b_fs I8fs^2] - 1}                                                   (2.14) [kPa]
///   I1 = tr C,  I4f = f.f,  I4s = s.s,  I8fs = f.s  with f = F f0, s = F s0                (2.15), (2.17)
///   I4i* = max(I4i, 1): fibres and sheets carry load in extension only                           (2.16)
///   P(F) = dW/dF - a exp[b(I1-3)] F^{-T}: no stress at rest                                      (2.18) [kPa]
///
/// The invariants are of the full F, not of its isochoric part. The second index of F and P is in
/// the fibre frame. The defaults are the paper's healthy subject (section 3.1).
struct HolzapfelOgden {
  double a = 0.24;    ///< [kPa]
  double b = 5.08;    ///< [-]
  double a_f = 1.46;  ///< [kPa]
  double b_f = 4.15;  ///< [-]
  double a_s = 0.87;  ///< [kPa]
  double b_s = 1.6;   ///< [-]
  double a_fs = 0.3;  ///< [kPa]
  double b_fs = 1.3;  ///< [-]

  template <class T>
  [[nodiscard]] T energy(const Tensor<T>& F) const;

  template <class T>
  [[nodiscard]] Tensor<T> stress(const Tensor<T>& F) const;

  /// dP/dF [kPa]. Not symmetric, because of the term of (2.18) that has no potential. Where
  /// I4f = 1 or I4s = 1, at the switches of (2.16), it is that of compression.
  [[nodiscard]] Tangent<double> tangent(const Mat3& F) const;

  /// The same law with all stiffnesses a multiplied by one factor and all exponents b by another.
  [[nodiscard]] HolzapfelOgden scaled(double stiffness, double exponent = 1.0) const;

  /// The same law with a_f, a_s, a_fs multiplied by C_a: the patient's remote muscle (2.25).
  [[nodiscard]] HolzapfelOgden with_anisotropy_scaled(double C_a) const;

 private:
  /// Derivative of a_i/2b_i exp(b_i x^2) by x, and its own slope.
  struct Load {
    double value = 0.0;
    double slope = 0.0;
  };
  [[nodiscard]] static Load load(double a_i, double b_i, double x) {
    const double e = a_i * std::exp(b_i * x * x);
    return {e * x, e * (1.0 + 2.0 * b_i * x * x)};
  }
};

template <class T>
T HolzapfelOgden::energy(const Tensor<T>& F) const {
  using std::exp;
  const auto f = F.col(0);
  const auto s = F.col(1);
  const T I1 = F.squaredNorm();
  const T If = maximum(f.squaredNorm(), T(1.0)) - 1.0;
  const T Is = maximum(s.squaredNorm(), T(1.0)) - 1.0;
  const T I8 = f.dot(s);
  return a / (2 * b) * exp(b * (I1 - 3.0)) + a_f / (2 * b_f) * (exp(b_f * If * If) - 1.0) +
         a_s / (2 * b_s) * (exp(b_s * Is * Is) - 1.0) +
         a_fs / (2 * b_fs) * (exp(b_fs * I8 * I8) - 1.0);
}

template <class T>
Tensor<T> HolzapfelOgden::stress(const Tensor<T>& F) const {
  using std::exp;
  const Vector<T> f = F.col(0);
  const Vector<T> s = F.col(1);
  const Tensor<T> cof = cofactor(F);
  const T J = f.dot(cof.col(0));
  const T I1 = f.squaredNorm() + s.squaredNorm() + F.col(2).squaredNorm();
  const T If = maximum(f.squaredNorm(), T(1.0)) - 1.0;
  const T Is = maximum(s.squaredNorm(), T(1.0)) - 1.0;
  const T I8 = f.dot(s);

  const T isotropic = a * exp(b * (I1 - 3.0));
  const T fibre = 2.0 * a_f * If * exp(b_f * If * If);
  const T sheet = 2.0 * a_s * Is * exp(b_s * Is * Is);
  const T shear = a_fs * I8 * exp(b_fs * I8 * I8);

  Tensor<T> P = isotropic * F - (isotropic / J) * cof;
  P.col(0) += fibre * f + shear * s;
  P.col(1) += sheet * s + shear * f;
  return P;
}

}  // namespace lv::material
