#include "lv/base/dense.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lv;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Of three columns, the last the sum of the others.
MatrixXd dependent() {
  return (MatrixXd(4, 3) << 1, 0, 1, 2, 1, 3, 0, 1, 1, -1, 2, 1).finished();
}

MatrixXd positive() {
  return (MatrixXd(3, 3) << 4, 1, 0, 1, 3, -1, 0, -1, 2).finished();
}

}  // namespace

TEST_CASE("a square system's solution fulfils it", "[unit][base]") {
  const VectorXd b = VectorXd::LinSpaced(3, 1.0, 2.0);
  CHECK((positive() * dense::solve(positive(), b) - b).norm() < 1e-14);
  const Vec3 b3(1.0, -2.0, 0.5);
  const Mat3 A3 = positive().topLeftCorner<3, 3>();
  CHECK((A3 * dense::solve(A3, b3) - b3).norm() < 1e-14);
  CHECK((positive() * dense::solve_symmetric(positive(), b) - b).norm() < 1e-14);
}

TEST_CASE("a least-squares solution leaves a residual normal to the columns, and is the shortest",
          "[unit][base]") {
  const MatrixXd A = dependent();
  const VectorXd b = VectorXd::LinSpaced(4, 1.0, 4.0);
  const VectorXd x = dense::least_squares(A, b);
  CHECK((A.transpose() * (A * x - b)).norm() < 1e-13);
  CHECK(std::abs(x[0] + x[1] - x[2]) < 1e-13);  // the null space is (1, 1, -1)
}

TEST_CASE("an orthonormal basis spans the columns", "[unit][base]") {
  const MatrixXd A = dependent().leftCols(2);
  const MatrixXd Q = dense::orthonormal(A);
  CHECK((Q.transpose() * Q - MatrixXd::Identity(2, 2)).norm() < 1e-14);
  CHECK((Q * (Q.transpose() * A) - A).norm() < 1e-14);
}

TEST_CASE("the inverse of a normal matrix is its pseudo-inverse where columns depend on each other",
          "[unit][base]") {
  const MatrixXd J = dependent();
  const MatrixXd N = J.transpose() * J;
  const MatrixXd inverse = dense::inverse_of_normal_matrix(J);
  CHECK((N * inverse * N - N).norm() < 1e-12 * N.norm());
  CHECK((inverse * N * inverse - inverse).norm() < 1e-12);
  const MatrixXd two = J.leftCols(2);
  CHECK((two.transpose() * two * dense::inverse_of_normal_matrix(two) - MatrixXd::Identity(2, 2))
            .norm() < 1e-13);
}

TEST_CASE("eigenpairs of a symmetric matrix ascend and rebuild it", "[unit][base]") {
  const dense::Eigenpairs pairs = dense::symmetric_eigenpairs(positive());
  CHECK(
      (pairs.vectors * pairs.values.asDiagonal() * pairs.vectors.transpose() - positive()).norm() <
      1e-13);
  CHECK(pairs.values[0] <= pairs.values[1]);
  CHECK(pairs.values[1] <= pairs.values[2]);
}
