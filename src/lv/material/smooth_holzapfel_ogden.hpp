#pragma once

#include "lv/material/tangent.hpp"

namespace lv::material {

/// Passive myocardium with smooth switches and an isochoric isotropic term (Arostica et al.,
/// Comput. Methods Appl. Mech. Engrg. 435:117485, 2025):
///
///   W(F) = a/2b exp[b(I1 J^{-2/3} - 3)] + a_fs/2b_fs {exp[b_fs I8fs^2] - 1}
///          + sum_{i=f,s} chi(I4i) a_i/2b_i {exp[b_i (I4i - 1)^2] - 1}                    [kPa]
///   chi(I4) = 1/(1 + exp[-k (I4 - 1)])
///   P(F) = dW/dF                                                                         [kPa]
///
/// I4f, I4s and I8fs are of the full F. The second index of F and P is in the fibre frame. The
/// defaults are the benchmark's.
struct SmoothHolzapfelOgden {
  double a = 0.059;      ///< [kPa]
  double b = 8.023;      ///< [-]
  double a_f = 18.472;   ///< [kPa]
  double b_f = 16.026;   ///< [-]
  double a_s = 2.481;    ///< [kPa]
  double b_s = 11.12;    ///< [-]
  double a_fs = 0.216;   ///< [kPa]
  double b_fs = 11.436;  ///< [-]
  double k = 100.0;      ///< sharpness of the switches [-]

  template <class T>
  [[nodiscard]] T energy(const Tensor<T>& F) const;

  template <class T>
  [[nodiscard]] Tensor<T> stress(const Tensor<T>& F) const;

  /// dP/dF [kPa]; symmetric.
  [[nodiscard]] Tangent<double> tangent(const Mat3& F) const;

 private:
  /// a_i/2b_i chi (exp[b_i x^2] - 1) of x = I4 - 1, with its first and second derivatives.
  template <class T>
  struct Term {
    T value, slope, curvature;
  };
  template <class T>
  [[nodiscard]] Term<T> switched(double a_i, double b_i, const T& x) const {
    using std::exp;
    const T chi = 1.0 / (1.0 + exp(-k * x));
    const T d_chi = k * chi * (1.0 - chi);
    const T dd_chi = k * d_chi * (1.0 - 2.0 * chi);
    const T e = exp(b_i * x * x);
    const T d_e = 2.0 * b_i * x * e;
    const T dd_e = 2.0 * b_i * (e + x * d_e);
    const double c = a_i / (2.0 * b_i);
    return {c * chi * (e - 1.0), c * (d_chi * (e - 1.0) + chi * d_e),
            c * (dd_chi * (e - 1.0) + 2.0 * d_chi * d_e + chi * dd_e)};
  }
};

template <class T>
T SmoothHolzapfelOgden::energy(const Tensor<T>& F) const {
  using std::exp;
  using std::log;
  const Vector<T> f = F.col(0);
  const Vector<T> s = F.col(1);
  const T I8 = f.dot(s);
  const T isochoric = exp(-2.0 / 3.0 * log(determinant(F)));
  return a / (2 * b) * exp(b * (isochoric * F.squaredNorm() - 3.0)) +
         switched<T>(a_f, b_f, f.squaredNorm() - 1.0).value +
         switched<T>(a_s, b_s, s.squaredNorm() - 1.0).value +
         a_fs / (2 * b_fs) * (exp(b_fs * I8 * I8) - 1.0);
}

template <class T>
Tensor<T> SmoothHolzapfelOgden::stress(const Tensor<T>& F) const {
  using std::exp;
  using std::log;
  const Vector<T> f = F.col(0);
  const Vector<T> s = F.col(1);
  const Tensor<T> cof = cofactor(F);
  const T J = f.dot(cof.col(0));
  const T I1 = f.squaredNorm() + s.squaredNorm() + F.col(2).squaredNorm();
  const T I8 = f.dot(s);

  const T isochoric = exp(-2.0 / 3.0 * log(J));
  const T isotropic = a * exp(b * (isochoric * I1 - 3.0)) * isochoric;
  const T fibre = 2.0 * switched<T>(a_f, b_f, f.squaredNorm() - 1.0).slope;
  const T sheet = 2.0 * switched<T>(a_s, b_s, s.squaredNorm() - 1.0).slope;
  const T shear = a_fs * I8 * exp(b_fs * I8 * I8);

  Tensor<T> P = isotropic * F - (isotropic * I1 / (3.0 * J)) * cof;
  P.col(0) += fibre * f + shear * s;
  P.col(1) += sheet * s + shear * f;
  return P;
}

}  // namespace lv::material
