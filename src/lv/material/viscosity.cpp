#include "lv/material/viscosity.hpp"

#include "lv/material/tangent_algebra.hpp"

namespace lv::material {

/// dP = dF S + eta/2 F (dF^T B + B^T dF) with B = F' + slope F.
Tangent<double> Viscosity::tangent(const Mat3& F, const Mat3& rate, double slope) const {
  const Mat3 S = 0.5 * eta * (F.transpose() * rate + rate.transpose() * F);
  const Mat3 B = rate + slope * F;
  Tangent<double> A;
  for (int j = 0; j < 3; ++j) {
    for (int l = 0; l < 3; ++l)
      block(A, j, l) = S(l, j) * Mat3::Identity() + 0.5 * eta * F.col(l) * B.col(j).transpose();
    block(A, j, j) += 0.5 * eta * F * B.transpose();
  }
  return A;
}

}  // namespace lv::material
