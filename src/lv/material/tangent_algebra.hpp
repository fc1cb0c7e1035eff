#pragma once

#include "lv/material/tangent.hpp"

/// What the tangents of the laws are made of; included by their sources alone, for every file that
/// sees it compiles it.
namespace lv::material {

/// The derivative of P's column j by F's column l.
inline auto block(Tangent<double>& A, int j, int l) {
  return A.block<3, 3>(3 * j, 3 * l);
}

/// A (x) B, the tangent of P = A (B : F).
inline Tangent<double> outer(const Mat3& A, const Mat3& B) {
  return A.reshaped() * B.reshaped().transpose();
}

/// dF^{-T}/dF = -G(i,l) G(k,j) with G = F^{-T}.
inline Tangent<double> inverse_transpose_tangent(const Mat3& G) {
  Tangent<double> A;
  for (int j = 0; j < 3; ++j)
    for (int l = 0; l < 3; ++l)
      block(A, j, l) = -G.col(l) * G.col(j).transpose();
  return A;
}

/// d cof(F)/dF. The cofactor's columns are cross products of F's, F_k x F_l, and the derivative of
/// a cross product is a cross product.
inline Tangent<double> cofactor_tangent(const Mat3& F) {
  Tangent<double> A = Tangent<double>::Zero();
  for (int j = 0; j < 3; ++j) {
    const int k = (j + 1) % 3;
    const int l = (j + 2) % 3;
    block(A, j, l) = cross_matrix(F.col(k));
    block(A, j, k) = -cross_matrix(F.col(l));
  }
  return A;
}

}  // namespace lv::material
