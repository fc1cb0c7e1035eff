#include "lv/material/smooth_holzapfel_ogden.hpp"

#include "lv/material/tangent_algebra.hpp"

namespace lv::material {

/// With D = F - I1/3 F^{-T} and m = J^{-2/3}, the isotropic stress is a exp[b(m I1 - 3)] m D, and
/// d(m I1)/dF = 2 m D, dm/dF = -2/3 m F^{-T}.
Tangent<double> SmoothHolzapfelOgden::tangent(const Mat3& F) const {
  const Vec3 f = F.col(0);
  const Vec3 s = F.col(1);
  const double I1 = F.squaredNorm();
  const double I8 = f.dot(s);
  const Mat3 cof = cofactor(F);
  const double J = f.dot(cof.col(0));
  const Mat3 G = cof / J;
  const Mat3 D = F - I1 / 3.0 * G;
  const double m = std::exp(-2.0 / 3.0 * std::log(J));
  const double isotropic = a * std::exp(b * (m * I1 - 3.0)) * m;
  const auto fibre = switched(a_f, b_f, f.squaredNorm() - 1.0);
  const auto sheet = switched(a_s, b_s, s.squaredNorm() - 1.0);
  const double e = a_fs * std::exp(b_fs * I8 * I8);
  Mat3 dI8;
  dI8 << s, f, Vec3::Zero();

  Tangent<double> A =
      isotropic * (Tangent<double>::Identity() - I1 / 3.0 * inverse_transpose_tangent(G)) +
      outer(isotropic * D, 2.0 * b * m * D - 2.0 / 3.0 * G) - outer(2.0 / 3.0 * isotropic * G, F) +
      outer(e * (1.0 + 2.0 * b_fs * I8 * I8) * dI8, dI8);
  block(A, 0, 0) +=
      2.0 * fibre.slope * Mat3::Identity() + 4.0 * fibre.curvature * f * f.transpose();
  block(A, 1, 1) +=
      2.0 * sheet.slope * Mat3::Identity() + 4.0 * sheet.curvature * s * s.transpose();
  block(A, 0, 1) += e * I8 * Mat3::Identity();
  block(A, 1, 0) += e * I8 * Mat3::Identity();
  return A;
}

}  // namespace lv::material
