#pragma once

#include "lv/material/tangent.hpp"

namespace lv::material {

/// What a fibre tension T means, with f = F f0, lambda = |f| and J = det F. The active first
/// Piola-Kirchhoff stress is P = g T f (x) f0, with
///
///   niederer      g = J             Cauchy stress T f (x) f, the fibre not normalised: (2.21), (2.22)
///   second_piola  g = 1             S = T f0 (x) f0: Land et al., Proc. R. Soc. A 471:20150641, 2015
///   cauchy        g = J / lambda^2  Cauchy stress T along the deformed unit fibre
enum class ActiveForm { niederer, second_piola, cauchy };

/// g as above, with I4f = lambda^2.
template <class T>
T active_factor(ActiveForm form, const T& J, const T& I4f) {
  if (form == ActiveForm::second_piola)
    return T(1.0);
  return form == ActiveForm::niederer ? J : J / I4f;
}

/// The first column of P [kPa], the only one that is not zero, since F's second index is in the
/// fibre frame (f = F.col(0)). J = det F.
template <class T>
Vector<T> active_stress_column(const Tensor<T>& F, const T& J, const T& tension,
                               ActiveForm form = ActiveForm::niederer) {
  const T I4f = F.col(0).squaredNorm();
  return (active_factor(form, J, I4f) * tension) * F.col(0);
}

/// dP/dF [kPa] of a tension T(lambda) with the slope T' = dT/dlambda [kPa]. With g = J^m lambda^n,
///
///   dP f0 = g T df + m g T (F^{-T} : dF) f + (g T' + n g T / lambda) / lambda (f . df) f
///
/// It is symmetric for second_piola alone, which has the potential int T lambda dlambda.
[[nodiscard]] Tangent<double> active_tangent(const Mat3& F, double tension, double slope,
                                             ActiveForm form = ActiveForm::niederer);

}  // namespace lv::material
