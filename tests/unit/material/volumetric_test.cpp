#include "lv/material/volumetric.hpp"

#include "support/law_checks.hpp"

using namespace lv;

TEST_CASE("the volumetric stress is the objective derivative of its energy", "[unit][material]") {
  test::check_law(material::Volumetric{100.0});  // the paper's beta_s
}

TEST_CASE("the volumetric stress is a pressure 2 beta_s log(J)/J that only volume sees",
          "[unit][material]") {
  const material::Volumetric law{100.0};
  for (const Mat3& F : test::deformations()) {
    const double J = determinant(F);
    const Mat3 cauchy = law.stress(F) * F.transpose() / J;
    // moduli of 100 kPa
    CHECK((cauchy - 200.0 * std::log(J) / J * Mat3::Identity()).norm() < 1e-12);
    const Mat3 isochoric = F / std::cbrt(J);
    CHECK(law.stress(isochoric).norm() < 1e-12);
  }
}
