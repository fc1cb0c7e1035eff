#include "lv/material/neo_hookean.hpp"

#include "support/law_checks.hpp"
#include "support/tangent_checks.hpp"

using namespace lv;

TEST_CASE("the neo-Hookean stress is the objective derivative of its energy", "[unit][material]") {
  test::check_law(material::NeoHookean{3.0});
}

TEST_CASE("the neo-Hookean tangent is the derivative of the stress", "[unit][material]") {
  const material::NeoHookean law{3.0};
  test::check_tangent(law);
  test::check_symmetric([&](const Mat3& F) { return law.tangent(F); });
}

TEST_CASE("the neo-Hookean shear stress is mu gamma", "[unit][material]") {
  Mat3 F = Mat3::Identity();
  F(0, 1) = 0.5;
  const Mat3 cauchy = material::NeoHookean{3.0}.stress(F) * F.transpose();
  CHECK(cauchy(0, 1) == Approx(1.5));
  CHECK(cauchy(0, 0) == Approx(0.75));  // mu gamma^2
  CHECK(std::abs(cauchy(1, 1)) < 1e-15);
}
