#include "lv/material/active_stress.hpp"

#include "lv/material/tangent_algebra.hpp"

namespace lv::material {

Tangent<double> active_tangent(const Mat3& F, double tension, double slope, ActiveForm form) {
  const double m = form == ActiveForm::second_piola ? 0.0 : 1.0;
  const double n = form == ActiveForm::cauchy ? -2.0 : 0.0;
  const Vec3 f = F.col(0);
  const Mat3 cof = cofactor(F);
  const double J = f.dot(cof.col(0));
  const double I4f = f.squaredNorm();
  const double g = active_factor(form, J, I4f);

  Tangent<double> A = Tangent<double>::Zero();
  A.topRows<3>() = (m * g * tension / J) * f * cof.reshaped().transpose();
  block(A, 0, 0) += g * tension * Mat3::Identity() +
                    g * (slope / std::sqrt(I4f) + n * tension / I4f) * f * f.transpose();
  return A;
}

}  // namespace lv::material
