#include "lv/implicit/contractility.hpp"

#include <catch2/catch.hpp>

using namespace lv;
using implicit::Contractility;
using implicit::Tension;

TEST_CASE("a prescribed tension goes by the activation alone", "[unit][implicit]") {
  const Contractility muscle(material::PrescribedTension{60.0}, {});
  for (const double stretch : {0.9, 1.1}) {
    CHECK(muscle.at(stretch, 0.0).value == 0.0);
    CHECK(muscle.at(stretch, 0.25).value == 15.0);
    CHECK(muscle.at(stretch, 1.0).value == 60.0);
    CHECK(muscle.at(stretch, 1.0).derivative == 0.0);
  }
}

TEMPLATE_TEST_CASE("a law with kinetics is blended from its rest and its peak", "[unit][implicit]",
                   material::NiedererHunterSmith, material::Land2017) {
  const TestType law;
  const material::Calcium calcium;
  const Contractility muscle(law, calcium);
  constexpr double h = 1e-5;
  for (const double stretch : {0.93, 1.07}) {
    const double rest = law.steady_state(calcium.Ca_0, stretch).tension;
    const double peak = law.steady_state(calcium.Ca_max, stretch).tension;
    REQUIRE(peak > 2.0 * rest);
    for (const double s : {0.0, 0.3, 1.0}) {
      const Tension T = muscle.at(stretch, s);
      CHECK(T.value == Approx((1.0 - s) * rest + s * peak).epsilon(1e-7).margin(1e-9));
      const double slope =
          (muscle.at(stretch + h, s).value - muscle.at(stretch - h, s).value) / (2.0 * h);
      CHECK(T.derivative == Approx(slope).epsilon(1e-6).margin(1e-6));
    }
  }
}
