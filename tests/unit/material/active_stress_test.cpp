#include "lv/material/active_stress.hpp"

#include "support/law_checks.hpp"
#include "support/tangent_checks.hpp"

namespace {

using namespace lv;
using material::ActiveForm;

constexpr std::array<ActiveForm, 3> forms{ActiveForm::niederer, ActiveForm::second_piola,
                                          ActiveForm::cauchy};

Mat3 stress(const Mat3& F, double tension, ActiveForm form) {
  Mat3 P = Mat3::Zero();
  P.col(0) = material::active_stress_column(F, determinant(F), tension, form);
  return P;
}

Mat3 cauchy(const Mat3& F, double tension, ActiveForm form) {
  return stress(F, tension, form) * F.transpose() / determinant(F);
}

/// A tension [kPa] that depends on the stretch, and its slope.
double tension(double stretch) {
  return 80.0 * std::exp(2.0 * (stretch - 1.0));
}
double slope(double stretch) {
  return 2.0 * tension(stretch);
}

material::Tangent<double> tangent(const Mat3& F, ActiveForm form) {
  const double stretch = F.col(0).norm();
  return material::active_tangent(F, tension(stretch), slope(stretch), form);
}

}  // namespace

TEST_CASE("the active stress pulls along the deformed fibre with T f (x) f (2.22)",
          "[unit][material]") {
  for (const Mat3& F : test::deformations()) {
    const Mat3 expected = 80.0 * F.col(0) * F.col(0).transpose();
    CHECK((cauchy(F, 80.0, ActiveForm::niederer) - expected).norm() < 1e-13 * expected.norm());
  }
}

TEST_CASE("an active second Piola-Kirchhoff stress is T along the undeformed fibre",
          "[unit][material]") {
  Mat3 expected = Mat3::Zero();
  expected(0, 0) = 60.0;
  for (const Mat3& F : test::deformations()) {
    const Mat3 S = F.inverse() * stress(F, 60.0, ActiveForm::second_piola);
    CHECK((S - expected).norm() < 1e-12 * 60.0);  // rounding of the inverse
  }
}

TEST_CASE("an active Cauchy stress is T along the deformed fibre, whatever its stretch",
          "[unit][material]") {
  for (const Mat3& F : test::deformations()) {
    const Vec3 fibre = F.col(0).normalized();
    const Mat3 expected = 60.0 * fibre * fibre.transpose();
    CHECK((cauchy(F, 60.0, ActiveForm::cauchy) - expected).norm() < 1e-13 * 60.0);
  }
}

TEST_CASE("packs have the active stresses of their lanes", "[unit][material]") {
  const auto all = test::deformations();
  std::array<Mat3, pack_size> F;
  std::copy_n(all.begin(), pack_size, F.begin());
  const Tensor<Pack> packs = test::packed(F);
  const Pack T = test::packed([](int i) { return 50.0 + i; });
  for (const ActiveForm form : forms) {
    Tensor<Pack> P = Tensor<Pack>::Constant(Pack(0.0));
    P.col(0) = material::active_stress_column(packs, determinant(packs), T, form);
    for (int i = 0; i < pack_size; ++i) {
      const Mat3 expected = stress(F[i], 50.0 + i, form);
      CHECK((test::lane(P, i) - expected).norm() < 1e-14 * expected.norm());
    }
  }
}

TEST_CASE("the active tangent is the derivative of the stress with all that T and J depend on",
          "[unit][material]") {
  for (const ActiveForm form : forms)
    test::check_tangent_is_derivative(
        [&](const Mat3& F) { return stress(F, tension(F.col(0).norm()), form); },
        [&](const Mat3& F) { return tangent(F, form); });
}

TEST_CASE("an active second Piola-Kirchhoff stress has a potential", "[unit][material]") {
  test::check_symmetric([](const Mat3& F) { return tangent(F, ActiveForm::second_piola); });
}
