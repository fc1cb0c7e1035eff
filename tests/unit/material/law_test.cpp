#include "lv/material/law.hpp"

#include "support/law_checks.hpp"

using namespace lv;

TEST_CASE("scar is fifty times as stiff and does not contract (2.23)-(2.24)", "[unit][material]") {
  const material::InfarctScaling infarct;
  CHECK(infarct.passive(0.0) == 1.0);
  CHECK(infarct.passive(1.0) == 50.0);
  CHECK(infarct.passive(0.5) == 25.5);
  CHECK(infarct.active(0.0) == 1.0);
  CHECK(infarct.active(1.0) == 0.0);
  CHECK(infarct.active(0.25) == 0.75);
  CHECK(material::InfarctScaling{0.0}.passive(1.0) == 1.0);
}

TEST_CASE("the active stress pulls along the deformed fibre with T f (x) f (2.22)",
          "[unit][material]") {
  for (const Mat3& F : test::deformations()) {
    const double J = determinant(F);
    Mat3 P = Mat3::Zero();
    P.col(0) = material::active_stress_column(F, J, 80.0);
    const Mat3 expected = 80.0 * F.col(0) * F.col(0).transpose();
    CHECK((P * F.transpose() / J - expected).norm() < 1e-13 * expected.norm());
  }
}
