#include "lv/material/guccione.hpp"

#include "support/law_checks.hpp"
#include "support/tangent_checks.hpp"
#include <Eigen/Eigenvalues>

using namespace lv;

TEST_CASE("the Guccione stress is the objective derivative of its energy", "[unit][material]") {
  test::check_law(material::Guccione{});
  test::check_law(material::Guccione{10.0, 1.0, 1.0, 1.0});  // Land et al. 2015, problem 2
}

TEST_CASE("the Guccione tangent is the derivative of the stress", "[unit][material]") {
  for (const material::Guccione& law :
       {material::Guccione{}, material::Guccione{10.0, 1.0, 1.0, 1.0}}) {
    test::check_tangent(law);
    test::check_symmetric([&](const Mat3& F) { return law.tangent(F); });
  }
}

TEST_CASE("the Guccione energy weighs every strain with its own stiffness", "[unit][material]") {
  const material::Guccione law{2.0, 8.0, 2.0, 4.0};
  const auto exponent = [&](int i, int j) {  // Q of a deformation with the strain E_ij = E_ji = 0.1
    Mat3 E = Mat3::Zero();
    E(i, j) = E(j, i) = 0.1;
    const Mat3 F = Eigen::SelfAdjointEigenSolver<Mat3>(2.0 * E + Mat3::Identity()).operatorSqrt();
    return std::log(1.0 + 2.0 * law.energy(F) / law.C);
  };
  CHECK(exponent(0, 0) == Approx(8.0 * 0.01));
  CHECK(exponent(1, 1) == Approx(2.0 * 0.01));
  CHECK(exponent(2, 2) == Approx(2.0 * 0.01));
  CHECK(exponent(1, 2) == Approx(2.0 * 2.0 * 0.01));  // E_sn and E_ns
  CHECK(exponent(0, 1) == Approx(2.0 * 4.0 * 0.01));
  CHECK(exponent(0, 2) == Approx(2.0 * 4.0 * 0.01));
}
