#include "lv/base/dense.hpp"

#define LAPACK_COMPLEX_CPP  // C's complex numbers bring a macro I
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <lapacke.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace lv::dense {
namespace {

/// What LAPACK has found, or no numbers where it has found nothing: a singular matrix, or numbers
/// that were none.
template <class Result>
Result found(lapack_int failed, Result result) {
  if (failed != 0)
    result.setConstant(std::numeric_limits<double>::quiet_NaN());
  return result;
}

lapack_int size(Eigen::Index n) {
  return static_cast<lapack_int>(n);
}

}  // namespace

Eigen::VectorXd as_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  Eigen::MatrixXd factors = A;
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(std::max(A.rows(), A.cols()), B.cols());
  X.topRows(B.rows()) = B;
  std::vector<lapack_int> order(static_cast<std::size_t>(A.cols()), 0);
  const double negligible =
      std::numeric_limits<double>::epsilon() * static_cast<double>(std::min(A.rows(), A.cols()));
  lapack_int rank = 0;
  const auto failed = LAPACKE_dgelsy(LAPACK_COL_MAJOR, size(A.rows()), size(A.cols()),
                                     size(B.cols()), factors.data(), size(A.rows()), X.data(),
                                     size(X.rows()), order.data(), negligible, &rank);
  return found(failed, Eigen::MatrixXd(X.topRows(A.cols())));
}

Eigen::MatrixXd inverse_of_normal_matrix(const Eigen::MatrixXd& J) {
  return least_squares(J.transpose() * J, Eigen::MatrixXd::Identity(J.cols(), J.cols()));
}

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& K, const Eigen::VectorXd& f) {
  return K.ldlt().solve(f);
}

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd Q = columns;
  const lapack_int rows = size(Q.rows()), count = size(Q.cols());
  Eigen::VectorXd scale(Q.cols());
  auto failed = LAPACKE_dgeqrf(LAPACK_COL_MAJOR, rows, count, Q.data(), rows, scale.data());
  if (failed == 0)
    failed = LAPACKE_dorgqr(LAPACK_COL_MAJOR, rows, count, count, Q.data(), rows, scale.data());
  return found(failed, std::move(Q));
}

Eigen::VectorXd solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  Eigen::MatrixXd factors = A, x = b;
  std::vector<lapack_int> order(static_cast<std::size_t>(A.rows()));
  const auto failed = LAPACKE_dgesv(LAPACK_COL_MAJOR, size(A.rows()), 1, factors.data(),
                                    size(A.rows()), order.data(), x.data(), size(A.rows()));
  return found(failed, std::move(x));
}

Vec3 solve(const Mat3& A, const Vec3& b) {
  return A.inverse() * b;
}

Eigenpairs symmetric_eigenpairs(const Eigen::MatrixXd& A) {
  Eigenpairs pairs{Eigen::VectorXd(A.rows()), A};
  const auto failed = LAPACKE_dsyev(LAPACK_COL_MAJOR, 'V', 'L', size(A.rows()),
                                    pairs.vectors.data(), size(A.rows()), pairs.values.data());
  return {found(failed, std::move(pairs.values)), found(failed, std::move(pairs.vectors))};
}

}  // namespace lv::dense
