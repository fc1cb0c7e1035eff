#include "lv/material/land2017.hpp"

#include "support/packs.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using material::CrossBridges;
using material::Land2017;

}  // namespace

TEST_CASE("a steady state of human muscle stays as it is, whatever the step", "[unit][material]") {
  const Land2017 law;
  for (const double Ca : {0.05, 0.3, 1.0})
    for (const double dt : {1e-4, 2e-3, 1.0}) {
      const CrossBridges<double> steady = law.steady_state(Ca, 1.07);
      CrossBridges<double> state = steady;
      for (int i = 0; i < 1000; ++i)
        law.advance(state, 1.07, Ca, Ca, dt);
      CHECK(state.CaTRPN == Approx(steady.CaTRPN).epsilon(1e-11));
      CHECK(state.B == Approx(steady.B).epsilon(1e-11));
      // down to 2e-6, what is left of sites that are not blocked
      CHECK(state.W == Approx(steady.W).epsilon(1e-9));
      CHECK(state.tension == Approx(steady.tension).epsilon(1e-9));
    }
}

TEST_CASE("the slope of human muscle's steady tension is its derivative", "[unit][material]") {
  const Land2017 law;
  for (const double Ca : {0.1, 0.5, 2.0})
    for (const double stretch : {0.8, 0.9, 1.0, 1.1, 1.19, 1.25}) {
      const double h = 1e-6;  // second-order differences
      const double slope =
          (law.steady_state(Ca, stretch + h).tension - law.steady_state(Ca, stretch - h).tension) /
          (2 * h);
      CHECK(law.steady_tension(Ca, stretch).value == law.steady_state(Ca, stretch).tension);
      CHECK(law.steady_tension(Ca, stretch).derivative == Approx(slope).epsilon(1e-6).margin(1e-6));
    }
}

TEST_CASE("human muscle resists a sudden stretch by A h (S + W) T_ref/r_s", "[unit][material]") {
  const Land2017 law;
  const CrossBridges<double> steady = law.steady_state(0.6, 0.86);
  const auto tension_after = [&](double strain) {
    CrossBridges<double> state = steady;
    law.advance(state, 0.86 + strain, 0.6, 0.6, 1e-10);
    return state.tension;
  };
  const double slope = (tension_after(1e-7) - tension_after(-1e-7)) / 2e-7;
  // the overlap changes too, by its own slope 2 beta_0
  const double overlap = law.T_ref / law.r_s * steady.S * 2.0 * law.beta_0;
  CHECK(slope - overlap == Approx(law.sudden_stiffness(steady)).epsilon(1e-5));
  CHECK(law.sudden_stiffness(steady) ==
        Approx(10.0 * law.overlap_tension(0.86) * (steady.S + steady.W)));
}

TEST_CASE("calcium never binds to more troponin than there is, nor do sites become fewer than none",
          "[unit][material]") {
  const Land2017 law;
  CrossBridges<double> state = law.steady_state(0.1, 1.0);
  for (int i = 0; i < 100; ++i) {
    law.advance(state, 1.0, 100.0, 100.0, 1e-3);
    CHECK(state.CaTRPN <= 1.0);
    CHECK(state.B >= 0.0);
    CHECK(state.W >= 0.0);
    CHECK(state.S >= 0.0);
  }
}

TEST_CASE("packs of human muscle advance like single cells", "[unit][material]") {
  const Land2017 law;
  const auto stretch = [](int i) { return 0.85 + 0.04 * i; };
  CrossBridges<Pack> pack;
  std::vector<CrossBridges<double>> single(pack_size);
  for (int step = 1; step <= 200; ++step) {
    const double swing = 1.0 + 0.02 * std::sin(0.1 * step);
    law.advance(pack, test::packed([&](int i) { return swing * stretch(i); }), 0.8, 0.9, 1e-4);
    for (int i = 0; i < pack_size; ++i)
      law.advance(single[i], swing * stretch(i), 0.8, 0.9, 1e-4);
  }
  for (int i = 0; i < pack_size; ++i) {
    // rounding of fused multiply-adds over 200 steps
    CHECK(pack.tension.get(i) == Approx(single[i].tension).epsilon(1e-10));
    CHECK(pack.zeta_s.get(i) == Approx(single[i].zeta_s).epsilon(1e-10).margin(1e-13));
  }
}
