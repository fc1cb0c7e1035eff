#pragma once

#include "lv/base/tensor.hpp"

#include <Eigen/Core>

#include <span>

namespace lv::implicit {

/// Displacements of a wall that are polynomials of place, of one total degree n at most; degree 1
/// is an affine map. The axial part is z times one of degree n - 1, so the base plane z = 0 stays a
/// plane.
class SmoothFields {
 public:
  /// Of displacements of these places, of which there must be more than monomials.
  SmoothFields(std::span<const Vec3> places, int degree);

  /// The nearest such field to a displacement, three numbers a node, in least squares over the
  /// nodes.
  [[nodiscard]] Eigen::VectorXd nearest(const Eigen::VectorXd& displacement) const;

 private:
  Eigen::MatrixXd across_, along_;  ///< orthonormal bases of x and y, and of z: a row a node
};

}  // namespace lv::implicit
