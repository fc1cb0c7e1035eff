#include "lv/material/stress_stretch.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lv;
using material::pulled_along_fibre;

namespace {

/// At a stretch of 1.1.
double stress(const material::AnyPassiveLaw& law) {
  const material::StressStretch curve = pulled_along_fibre("", law);
  REQUIRE(curve.stretch.at(40) == Approx(1.1));
  return curve.stress.at(40);
}

}  // namespace

TEST_CASE("muscle pulled along the fibre has the closed form's stress", "[unit][material]") {
  // a exp[b(l^2 + 2/l - 3)](l^2 - 1/l) + 2 C_a a_f (l^2 - 1) l^2 exp[b_f (l^2 - 1)^2]: in
  // compression the sheets carry nothing
  CHECK(stress(material::HolzapfelOgden{}) == Approx(0.97431794).epsilon(1e-7));
  // l dW/dl with W = C/2 (e^Q - 1), Q = b_f E^2 + 2 b_t E_t^2, E = (l^2 - 1)/2, E_t = (1/l - 1)/2
  const double E = 0.5 * (1.1 * 1.1 - 1.0);
  const double E_t = 0.5 * (1.0 / 1.1 - 1.0);
  CHECK(stress(material::Guccione{2.0, 8.0, 2.0, 4.0}) ==
        Approx(2.0 * std::exp(8.0 * E * E + 4.0 * E_t * E_t) * (8.0 * E * 1.21 - 2.0 * E_t / 1.1)));
  // mu (l^2 - 1/l)
  CHECK(stress(material::NeoHookean{1.0}) == Approx(1.21 - 1.0 / 1.1));
}

TEST_CASE("a curve of stress against stretch is left where it reaches 12 kPa", "[unit][material]") {
  const auto published = material::published_muscles();
  for (const material::StressStretch& curve : published) {
    CHECK(curve.is_published);
    CHECK(curve.stress.front() == Approx(0.0).margin(1e-12));
    CHECK(curve.stress.back() <= 12.0);
  }
  CHECK(published.front().stretch.back() == Approx(1.25).margin(0.05));
  CHECK(published.back().stretch.back() < 1.1);  // 19.05 kPa there
}
