#include "lv/material/smooth_holzapfel_ogden.hpp"

#include "lv/material/compressibility.hpp"
#include "lv/material/viscosity.hpp"

#include "support/law_checks.hpp"
#include "support/tangent_checks.hpp"

namespace {

using namespace lv;
using material::SmoothHolzapfelOgden;

const SmoothHolzapfelOgden benchmark;
// the differences that tangents are compared with resolve switches no sharper than this
const SmoothHolzapfelOgden blunt{
    .a = 0.4, .b = 5.0, .a_f = 1.5, .b_f = 4.0, .a_s = 0.9, .b_s = 1.6, .k = 3.0};

}  // namespace

TEST_CASE("the smooth Holzapfel-Ogden law is a law", "[unit][material]") {
  test::check_law(blunt);
  test::check_no_stress_at_rest(benchmark);
  test::check_objective(benchmark);
  test::check_packs_agree(benchmark);
}

TEST_CASE("the smooth law's tangent is the derivative of its stress", "[unit][material]") {
  test::check_tangent(blunt);
  test::check_symmetric([](const Mat3& F) { return benchmark.tangent(F); });
  for (const Mat3& F : test::strained(100)) {
    const auto expected = test::tangent_of([](const Mat3& G) { return benchmark.stress(G); }, F);
    CHECK((benchmark.tangent(F) - expected).norm() < 1e-6 * expected.norm());
  }
}

TEST_CASE("the smooth law's isotropic term does not feel volume", "[unit][material]") {
  const SmoothHolzapfelOgden isotropic{.a = 2.0, .a_f = 0.0, .a_s = 0.0, .a_fs = 0.0};
  CHECK(isotropic.stress(Mat3(1.3 * Mat3::Identity())).norm() < 1e-12);
  for (const Mat3& F : test::deformations())
    CHECK(isotropic.energy(Mat3(1.1 * F)) == Approx(isotropic.energy(F)).epsilon(1e-12));
}

TEST_CASE("fibres carry load in extension, and hardly any in compression", "[unit][material]") {
  const SmoothHolzapfelOgden fibres{.a = 0.0, .a_s = 0.0, .a_fs = 0.0};
  Mat3 longer = Mat3::Identity();
  longer(0, 0) = std::sqrt(1.2);
  const double x = 0.2;
  const double full = 2.0 * fibres.a_f * x * std::exp(fibres.b_f * x * x) * longer(0, 0);
  CHECK(fibres.stress(longer)(0, 0) == Approx(full).epsilon(1e-6));  // 1 - chi = 2e-9
  Mat3 shorter = Mat3::Identity();
  shorter(0, 0) = std::sqrt(0.8);
  CHECK(std::abs(fibres.stress(shorter)(0, 0)) < 1e-6);
}

TEST_CASE("viscous stress is that of the rate of strain", "[unit][material]") {
  const material::Viscosity viscosity{0.3};
  test::RandomValues random(5);
  for (const Mat3& F : test::deformations()) {
    const Mat3 spin = cross_matrix(random.vector());
    CHECK(viscosity.stress(F, Mat3(spin * F)).norm() < 1e-12);  // a rotation is no strain
    const Mat3 rate = random.tensor();
    const Mat3 S = F.inverse() * viscosity.stress(F, rate);
    constexpr double h = 1e-6;
    const auto strain = [](const Mat3& G) { return Mat3(0.5 * G.transpose() * G); };
    const Mat3 of_strain = 0.3 * (strain(F + h * rate) - strain(F - h * rate)) / (2.0 * h);
    CHECK((S - of_strain).norm() < 1e-8);
  }
}

TEST_CASE("the viscous tangent follows the rate that follows F", "[unit][material]") {
  const material::Viscosity viscosity{0.3};
  test::RandomValues random(6);
  const Mat3 rate_0 = random.tensor();
  constexpr double slope = 40.0;
  const auto rate = [&](const Mat3& F) { return Mat3(rate_0 + slope * (F - Mat3::Identity())); };
  test::check_tangent_is_derivative(
      [&](const Mat3& F) { return viscosity.stress(F, rate(F)); },
      [&](const Mat3& F) { return viscosity.tangent(F, rate(F), slope); });
}

TEST_CASE("volume follows tension as the volumetric energy asks", "[unit][material]") {
  const material::Compressibility soft{50.0};
  for (const double p : {-40.0, -1.0, 0.0, 3.0, 70.0}) {
    const double J = soft.J(p);
    CHECK(0.5 * soft.kappa * (J - 1.0 / J) == Approx(p).margin(1e-12));
    constexpr double h = 1e-4;
    CHECK(soft.slope(p) == Approx((soft.J(p + h) - soft.J(p - h)) / (2.0 * h)).epsilon(1e-7));
  }
  const material::Compressibility incompressible;
  CHECK(incompressible.J(123.0) == 1.0);
  CHECK(incompressible.slope(123.0) == 0.0);
}
