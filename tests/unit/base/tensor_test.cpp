#include "lv/base/tensor.hpp"

#include "support/packs.hpp"
#include "support/random_values.hpp"
#include <Eigen/LU>
#include <catch2/catch.hpp>

using namespace lv;

TEST_CASE("determinants and cofactors are those of linear algebra", "[unit][base]") {
  test::RandomValues random(1);
  for (int i = 0; i < 20; ++i) {
    const Mat3 F = random.tensor();
    CHECK(determinant(F) == Approx(F.determinant()).margin(1e-15));
    // F cof(F)^T = det(F) 1 also where F has no inverse; entries are of size 1
    CHECK((F * cofactor(F).transpose() - determinant(F) * Mat3::Identity()).norm() < 1e-15 * 10);
  }
  Mat3 singular = random.tensor();
  singular.col(2) = singular.col(0) + singular.col(1);
  CHECK(std::abs(determinant(singular)) < 1e-15);
  CHECK((singular * cofactor(singular).transpose()).norm() < 1e-15 * 10);
  CHECK(cofactor(singular).norm() > 0.1);
}

TEST_CASE("tensor functions do in every lane of a pack what they do for a double", "[unit][base]") {
  test::RandomValues random(2);
  std::array<Mat3, pack_size> F;
  for (Mat3& lane : F)
    lane = random.tensor();
  const Tensor<Pack> packed = test::packed(F);
  const Pack det = determinant(packed);
  const Tensor<Pack> cof = cofactor(packed);
  for (int i = 0; i < pack_size; ++i) {
    // fused multiply-adds may round differently
    CHECK(det.get(i) == Approx(determinant(F[i])).margin(1e-15));
    CHECK((test::lane(cof, i) - cofactor(F[i])).norm() < 1e-15);
  }
}

TEST_CASE("choices are made lane by lane", "[unit][base]") {
  const Pack x = test::packed([](int i) { return i - 2.0; });
  const Pack chosen = select(x < Pack(0.0), Pack(-1.0), Pack(1.0));
  for (int i = 0; i < pack_size; ++i) {
    CHECK(maximum(x, Pack(0.5)).get(i) == maximum(i - 2.0, 0.5));
    CHECK(minimum(x, Pack(0.5)).get(i) == minimum(i - 2.0, 0.5));
    CHECK(chosen.get(i) == select(i < 2, -1.0, 1.0));
  }
}

TEST_CASE("whole powers are repeated products", "[unit][base]") {
  double product = 1.0;
  for (int n = 0; n < 12; ++n, product *= 1.5)
    CHECK(power(1.5, n) == product);  // exact in binary
  CHECK(power(-2.0, 3) == -8.0);
  CHECK(power(0.0, 0) == 1.0);
}
