#include "lv/implicit/sparse.hpp"

#include "support/random_values.hpp"
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <numeric>

namespace {

using namespace lv;
using implicit::SparseMatrix;

/// Two elements of two nodes and a pressure each, that meet in a node.
implicit::Pattern pair_of_elements() {
  return {3, 2, {{0, 1, 2, 3, 4, 5, 9}, {3, 4, 5, 6, 7, 8, 10}}, {0, 0}, {}};
}

const std::vector<Vec3> places{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};

/// [ A  B ; B^T  0 ] with A definite.
Eigen::MatrixXd saddle_point(test::RandomValues& random) {
  Eigen::MatrixXd K(7, 7);
  for (double& entry : K.reshaped())
    entry = random();
  K = (K + K.transpose()).eval();
  K.topLeftCorner(6, 6) += 10.0 * Eigen::MatrixXd::Identity(6, 6);
  K(6, 6) = 0.0;
  return K;
}

/// Both elements' blocks, and the same as a dense matrix.
Eigen::MatrixXd assemble(SparseMatrix& K, unsigned seed) {
  test::RandomValues random(seed);
  const implicit::Pattern pattern = pair_of_elements();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(pattern.size(), pattern.size());
  K.set_zero();
  for (const std::vector<int>& group : pattern.groups) {
    const Eigen::MatrixXd block = saddle_point(random);
    K.add(group, block);
    dense(group, group) += block;
  }
  K.finish();
  return dense;
}

double largest_error(SparseMatrix& K, const Eigen::MatrixXd& dense) {
  std::vector<double> b(static_cast<std::size_t>(dense.rows()));
  std::iota(b.begin(), b.end(), 1.0);
  const auto x = K.solve(b).value();
  const Eigen::Map<const Eigen::VectorXd> found(x.data(), dense.rows()),
      right(b.data(), dense.rows());
  return (dense * found - right).lpNorm<Eigen::Infinity>();
}

}  // namespace

TEST_CASE("a saddle-point system is solved, and again when its matrix has changed",
          "[unit][implicit]") {
  SparseMatrix K(pair_of_elements(), {}, places);
  CHECK(largest_error(K, assemble(K, 1)) < 1e-11);
  CHECK(largest_error(K, assemble(K, 2)) < 1e-11);
  CHECK(K.iterations() == 0);  // the direct method
}

TEST_CASE("a singular matrix is reported, and the next one solved", "[unit][implicit]") {
  SparseMatrix K(pair_of_elements(), {}, places);
  K.set_zero();
  for (const std::vector<int>& group : pair_of_elements().groups)
    K.add(group, Eigen::MatrixXd::Zero(7, 7));
  K.add(std::array{0, 1, 2}, Eigen::Matrix3d::Identity());  // nothing holds the rest
  K.finish();
  const auto x = K.solve(std::vector<double>(11, 1.0));
  REQUIRE_FALSE(x);
  CHECK_THAT(x.why().what, Catch::Matchers::Contains("singular"));
  CHECK(largest_error(K, assemble(K, 3)) < 1e-11);
}
