#include "lv/base/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace lv::dense {

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.completeOrthogonalDecomposition().solve(B);
}

Eigen::MatrixXd inverse_of_normal_matrix(const Eigen::MatrixXd& J) {
  return (J.transpose() * J).completeOrthogonalDecomposition().pseudoInverse();
}

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& K, const Eigen::VectorXd& f) {
  return K.ldlt().solve(f);
}

Eigen::VectorXd solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.partialPivLu().solve(b);
}

Eigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace lv::dense
