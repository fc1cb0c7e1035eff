#pragma once

#include "lv/base/tensor.hpp"
#include "lv/material/tangent.hpp"

#include <Eigen/Core>

#include <array>

namespace lv::implicit {

/// The displacements' part of an element's tangent,
///
///   K_ab(i,k) = sum_q G_a . C_ik G_b
///
/// with the gradients G_a of the shapes at quadrature point q and C_ik(j,l) a tensor there: one
/// product of matrices for each i and k.
class ElementProduct {
 public:
  ElementProduct(Eigen::Index nodes, std::size_t points)
      : gradients_(3 * static_cast<Eigen::Index>(points), nodes) {
    for (auto& Y : fluxes_)
      Y.resize(gradients_.rows(), nodes);
  }

  /// Quadrature point q, with G (3 x nodes) and C, row i + 3 j and column k + 3 l.
  void set(Eigen::Index q, const Eigen::Matrix3Xd& G, const material::Tangent<double>& C) {
    gradients_.middleRows(3 * q, 3) = G;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        Mat3 C_ik;
        for (int j = 0; j < 3; ++j)
          for (int l = 0; l < 3; ++l)
            C_ik(j, l) = C(i + 3 * j, k + 3 * l);
        for (Eigen::Index b = 0; b < G.cols(); ++b)
          fluxes_[3 * i + k].block<3, 1>(3 * q, b).noalias() = C_ik * G.col(b);
      }
    }
  }

  /// Sets the first 3 x nodes rows and columns of a matrix, node by node.
  void multiply(Eigen::MatrixXd& K) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        product_.noalias() = gradients_.transpose() * fluxes_[3 * i + k];
        for (Eigen::Index b = 0; b < product_.cols(); ++b)
          for (Eigen::Index a = 0; a < product_.rows(); ++a)
            K(3 * a + i, 3 * b + k) = product_(a, b);
      }
    }
  }

 private:
  Eigen::MatrixXd gradients_;              ///< G, of all points
  std::array<Eigen::MatrixXd, 9> fluxes_;  ///< C_ik G
  Eigen::MatrixXd product_;
};

}  // namespace lv::implicit
