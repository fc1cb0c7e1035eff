#include "lv/material/steady_tension.hpp"

#include "lv/base/check.hpp"

#include "support/steady_reference.hpp"
#include <catch2/catch.hpp>

#include <array>
#include <cmath>

namespace {

using namespace lv;
using material::NiedererHunterSmith;
using material::SteadyTension;

NiedererHunterSmith scaled(double T_scale) {
  NiedererHunterSmith law;
  law.T_scale = T_scale;
  return law;
}

/// Derivative by central differences, extrapolated to order four.
template <class Function>
double slope(const Function& f, double x) {
  const auto difference = [&](double h) { return (f(x + h) - f(x - h)) / (2.0 * h); };
  return (4.0 * difference(1e-4) - difference(2e-4)) / 3.0;
}

}  // namespace

TEST_CASE("the tabulated steady tension is that of the reference", "[unit][material]") {
  for (const auto& row : test::steady_reference) {
    const SteadyTension steady(scaled(1.0), row.Ca);
    for (int i = 0; i < 3; ++i)  // eight digits, and the table's own 1e-8
      CHECK(steady.tension(row.stretch[i]) == Approx(row.tension[i]).epsilon(4e-8));
  }
}

TEST_CASE("the tabulated tension is the steady state's at every stretch", "[unit][material]") {
  const NiedererHunterSmith law;
  for (const double Ca : {0.01, 0.1, 0.3, 0.5, 1.0, 3.0}) {
    const SteadyTension steady(law, Ca);
    for (double stretch = 0.75; stretch < 1.2; stretch += 0.000317) {
      const double expected = law.steady_state(Ca, stretch).tension;
      CHECK(std::abs(steady.tension(stretch) - expected) < 1e-8 * expected);
    }
  }
}

TEST_CASE("the derivative of the steady tension is that of its table", "[unit][material]") {
  const NiedererHunterSmith law;
  for (const double Ca : {0.01, 1.0}) {
    const SteadyTension steady(law, Ca);
    for (double stretch = 0.8003; stretch < 1.1497; stretch += 0.000717) {
      const auto tabulated = [&](double x) { return steady.tension(x); };
      const auto exact = [&](double x) { return law.steady_state(Ca, x).tension; };
      const double derivative = steady.derivative(stretch);
      // rounding of the tension, 1e-14 of it, over steps of 1e-4
      CHECK(derivative == Approx(slope(tabulated, stretch)).epsilon(1e-9));
      CHECK(derivative == Approx(slope(exact, stretch)).epsilon(1e-9));
    }
  }
}

TEST_CASE("the steady tension is constant beyond the limits of stretch", "[unit][material]") {
  const SteadyTension steady(NiedererHunterSmith{}, 1.0);
  CHECK(steady.tension(1.3) == steady.tension(1.15));
  CHECK(steady.tension(0.5) == steady.tension(0.8));
  CHECK(steady.derivative(1.1501) == 0.0);
  CHECK(steady.derivative(0.7999) == 0.0);
  CHECK(steady.derivative(1.1499) > 500.0);
  CHECK(steady.derivative(0.8001) > 100.0);
}

TEST_CASE("T_scale multiplies the steady tension exactly", "[unit][material]") {
  const SteadyTension weak(scaled(1.0), 1.0);
  const SteadyTension strong(scaled(4.0), 1.0);  // a power of two: not even rounding differs
  const SteadyTension none(scaled(0.0), 1.0);
  for (double stretch = 0.75; stretch < 1.2; stretch += 0.0123) {
    CHECK(strong.tension(stretch) == 4.0 * weak.tension(stretch));
    CHECK(strong.derivative(stretch) == 4.0 * weak.derivative(stretch));
    CHECK(none.tension(stretch) == 0.0);
    CHECK(none.derivative(stretch) == 0.0);
  }
}

TEST_CASE("muscle may be limited to one stretch", "[unit][material]") {
  NiedererHunterSmith law;
  law.stretch_min = law.stretch_max = 1.0;
  const SteadyTension steady(law, 1.0);
  const double expected = law.steady_state(1.0, 1.0).tension;
  for (const double stretch : {0.9, 1.0, 1.1}) {
    CHECK(steady.tension(stretch) == Approx(expected).epsilon(1e-12));
    CHECK(std::abs(steady.derivative(stretch)) < 1e-9);
  }
}

TEST_CASE("calcium with two steady states is refused", "[unit][material]") {
  const NiedererHunterSmith law;
  // weak at the one, strong at the other, and both are possible between them
  CHECK(law.steady_state(0.4, 1.14).tension > 4.0 * law.steady_state(0.4, 1.13).tension);
  CHECK_THROWS_AS(SteadyTension(law, 0.4), RunError);
}
