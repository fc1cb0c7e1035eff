#include "lv/material/holzapfel_ogden.hpp"

#include "lv/material/tangent_algebra.hpp"

namespace lv::material {

Tangent<double> HolzapfelOgden::tangent(const Mat3& F) const {
  const Vec3 f = F.col(0);
  const Vec3 s = F.col(1);
  const double I4f = f.squaredNorm();
  const double I4s = s.squaredNorm();
  const Load fibre = I4f > 1.0 ? load(a_f, b_f, I4f - 1.0) : Load{};
  const Load sheet = I4s > 1.0 ? load(a_s, b_s, I4s - 1.0) : Load{};
  const Load shear = load(a_fs, b_fs, f.dot(s));
  const double isotropic = a * std::exp(b * (F.squaredNorm() - 3.0));
  const Mat3 G = cofactor(F) / determinant(F);
  Mat3 dI8;
  dI8 << s, f, Vec3::Zero();

  Tangent<double> A = isotropic * (Tangent<double>::Identity() - inverse_transpose_tangent(G)) +
                      outer(2.0 * b * isotropic * (F - G), F) + outer(shear.slope * dI8, dI8);
  block(A, 0, 0) += 2.0 * fibre.value * Mat3::Identity() + 4.0 * fibre.slope * f * f.transpose();
  block(A, 1, 1) += 2.0 * sheet.value * Mat3::Identity() + 4.0 * sheet.slope * s * s.transpose();
  block(A, 0, 1) += shear.value * Mat3::Identity();
  block(A, 1, 0) += shear.value * Mat3::Identity();
  return A;
}

HolzapfelOgden HolzapfelOgden::scaled(double stiffness, double exponent) const {
  HolzapfelOgden law = *this;
  for (double* modulus : {&law.a, &law.a_f, &law.a_s, &law.a_fs})
    *modulus *= stiffness;
  for (double* power : {&law.b, &law.b_f, &law.b_s, &law.b_fs})
    *power *= exponent;
  return law;
}

HolzapfelOgden HolzapfelOgden::with_anisotropy_scaled(double C_a) const {
  HolzapfelOgden scaled = *this;
  scaled.a_f *= C_a;
  scaled.a_s *= C_a;
  scaled.a_fs *= C_a;
  return scaled;
}

}  // namespace lv::material
