#include "lv/material/myocardium.hpp"

#include "support/law_checks.hpp"
#include "support/packs.hpp"
#include "support/tangent_checks.hpp"
#include <catch2/catch.hpp>

#include <type_traits>
#include <vector>

namespace {

using namespace lv;
using material::ActiveForm;
using material::Myocardium;
using material::Tension;

constexpr double extent = 0.3;         // of the infarct, M
constexpr double slope_of_rate = 7.0;  // dF'/dF [1/s]

/// A wall of every law, infarcted, contracting and viscous.
std::vector<Myocardium> walls(ActiveForm form) {
  std::vector<Myocardium> result;
  for (const material::AnyPassiveLaw& law : {material::AnyPassiveLaw{material::HolzapfelOgden{}},
                                             {material::Guccione{}},
                                             {material::NeoHookean{3.0}},
                                             {material::SmoothHolzapfelOgden{.a = 1.0, .k = 10.0}}})
    result.push_back(
        {.passive = law, .volumetric = {}, .infarct = {}, .active_form = form, .viscosity = {0.4}});
  return result;
}

template <class F>
void for_point_laws(ActiveForm form, const F& f) {
  for (const Myocardium& wall : walls(form))
    material::with_point_law(wall, material::Volumetric{100.0}, f);
}

/// A tension that rises with the stretch, and int T lambda dlambda.
Tension rising_tension(const Mat3& F) {
  return {30.0 + 40.0 * (F.col(0).norm() - 1.0), 40.0};
}
double potential(const Mat3& F) {
  const double l = F.col(0).norm();
  return 15.0 * (l * l - 1.0) + 40.0 * (l * l * l / 3.0 - l * l / 2.0 + 1.0 / 6.0);
}

Mat3 rate(const Mat3& F) {
  Mat3 at_rest;
  at_rest << 0.3, -0.2, 0.1, 0.5, 0.0, -0.4, 0.2, 0.6, -0.3;
  return at_rest + slope_of_rate * F;
}

}  // namespace

TEST_CASE("the sum of stresses is the derivative of the sum of energies, infarct and all",
          "[unit][material]") {
  for_point_laws(ActiveForm::second_piola, []<class Law>(const material::PointLaw<Law>& law) {
    if constexpr (!std::is_same_v<Law,
                                  material::HolzapfelOgden>)  // (2.18) derives from no energy
      test::check_stress_is_derivative(
          [&](const Mat3& F) {
            return law.stress(F, determinant(F), rising_tension(F).value, extent);
          },
          [&](const Mat3& F) { return law.energy(F, extent) + (1.0 - extent) * potential(F); },
          1e-7);  // exponents of 10, whose differences are so far off
  });
}

TEST_CASE("the sum of tangents is the derivative of the sum of stresses", "[unit][material]") {
  for (const ActiveForm form : {ActiveForm::niederer, ActiveForm::second_piola, ActiveForm::cauchy})
    for_point_laws(form, [](const auto& law) {
      test::check_tangent_is_derivative(
          [&](const Mat3& F) {
            return law.stress(F, determinant(F), rising_tension(F).value, extent);
          },
          [&](const Mat3& F) { return law.tangent(F, rising_tension(F), extent); });
      test::check_tangent_is_derivative(
          [&](const Mat3& F) {
            return law.stress(F, determinant(F), rising_tension(F).value, extent, rate(F));
          },
          [&](const Mat3& F) {
            return law.tangent(F, rising_tension(F), extent, rate(F), slope_of_rate);
          });
    });
}

TEST_CASE("an infarct scales the passive part alone by 1 + 49 M and the tension by 1 - M",
          "[unit][material]") {
  const Mat3 F = test::strained(1).front();
  const double J = determinant(F);
  for_point_laws(ActiveForm::niederer, [&](const auto& law) {
    const Mat3 volumetric = law.volumetric.stress(F);
    const Mat3 passive = law.stress(F, J, 0.0, 0.0) - volumetric;
    const Mat3 active = law.stress(F, J, 50.0, 0.0) - law.stress(F, J, 0.0, 0.0);
    const Mat3 expected = (1.0 + 49.0 * extent) * passive + (1.0 - extent) * active + volumetric;
    CHECK((law.stress(F, J, 50.0, extent) - expected).norm() < 1e-12 * expected.norm());
    CHECK(law.tension_left(50.0, extent) == Approx(35.0));
    CHECK((active.col(0) - J * 50.0 * F.col(0)).norm() < 1e-10 * active.norm());  // (2.21)
    CHECK(law.energy(F, extent) - law.volumetric.energy(F) ==
          Approx((1.0 + 49.0 * extent) * (law.energy(F, 0.0) - law.volumetric.energy(F))));
  });
}

TEST_CASE("packs of points have the sum of stresses that single points have", "[unit][material]") {
  std::array<Mat3, pack_size> F;
  const std::vector<Mat3> all = test::deformations();
  std::copy_n(all.begin(), pack_size, F.begin());
  const Tensor<Pack> packed = test::packed(F);
  for_point_laws(ActiveForm::niederer, [&](const auto& law) {
    const Tensor<Pack> P = law.stress(packed, determinant(packed), Pack(50.0), Pack(extent));
    for (int i = 0; i < pack_size; ++i) {
      const Mat3 expected = law.stress(F[i], determinant(F[i]), 50.0, extent);
      CHECK((test::lane(P, i) - expected).norm() <
            1e-12 * (1.0 + expected.norm()));  // the parts may cancel
    }
  });
}
