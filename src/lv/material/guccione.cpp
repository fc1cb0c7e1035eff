#include "lv/material/guccione.hpp"

#include "lv/material/tangent_algebra.hpp"

namespace lv::material {

Tangent<double> Guccione::tangent(const Mat3& F) const {
  const Mat3 E = strain(F);
  const double C_exp_Q = C * std::exp(exponent(E));
  Mat3 b;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      b(i, j) = weight(i, j);
  const Mat3 bE = b.cwiseProduct(E);
  const Mat3 half_dQ = F * bE;  // dQ/dF = 2 F bE

  Tangent<double> A = 2.0 * outer(half_dQ, half_dQ);
  for (int j = 0; j < 3; ++j) {
    // dE_mj/dF_kl = (d_ml F_kj + F_km d_jl) / 2
    block(A, j, j) += 0.5 * F * b.col(j).asDiagonal() * F.transpose();
    for (int l = 0; l < 3; ++l)
      block(A, j, l) +=
          bE(l, j) * Mat3::Identity() + 0.5 * b(l, j) * F.col(l) * F.col(j).transpose();
  }
  return C_exp_Q * A;
}

}  // namespace lv::material
