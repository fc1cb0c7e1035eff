#pragma once

#include "lv/base/tensor.hpp"

#include <Eigen/Core>

#include <vector>

/// Solutions of small dense problems, by LAPACK: templates for them take a compiler seconds each.
/// Where there is no solution, or a number is none, neither are those of the result.
namespace lv::dense {

/// Numbers as a vector.
[[nodiscard]] Eigen::VectorXd as_vector(const std::vector<double>& numbers);

/// X that makes |A X - B| smallest, and of all such the shortest.
[[nodiscard]] Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// (J^T J)^-1, or the pseudo-inverse where the columns of J depend on each other.
[[nodiscard]] Eigen::MatrixXd inverse_of_normal_matrix(const Eigen::MatrixXd& J);

/// x of K x = f for a symmetric, semidefinite K.
[[nodiscard]] Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& K, const Eigen::VectorXd& f);

/// An orthonormal basis of what the columns span, which must be independent.
[[nodiscard]] Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

/// x of A x = b for an invertible A.
[[nodiscard]] Eigen::VectorXd solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
[[nodiscard]] Vec3 solve(const Mat3& A, const Vec3& b);

/// A = V diag(values) V^T.
struct Eigenpairs {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< as columns, of unit length
};

/// Eigenvalues and eigenvectors of a symmetric A.
[[nodiscard]] Eigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& A);

}  // namespace lv::dense
