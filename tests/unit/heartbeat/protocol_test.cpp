#include "lv/heartbeat/protocol.hpp"

#include "lv/heartbeat/beat.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using heartbeat::Phase;
using heartbeat::phases;
using heartbeat::Protocol;
using heartbeat::SteadyVolume;

constexpr double mmHg = 0.133322387415;

/// Feeds volume(t) every millisecond; the time at which the criterion first holds, or -1.
template <class Volume>
double first_steady(double window, double tolerance, double end, const Volume& volume) {
  SteadyVolume steady(window, tolerance);
  for (int i = 0; i * 1e-3 <= end; ++i) {
    steady.record(i * 1e-3, volume(i * 1e-3));
    if (steady.reached())
      return i * 1e-3;
  }
  return -1.0;
}

}  // namespace

TEST_CASE("the smooth step rises from 0 to 1 without slope or curvature at its ends",
          "[unit][heartbeat]") {
  using heartbeat::smooth_step;
  CHECK(smooth_step(-1.0) == 0.0);
  CHECK(smooth_step(0.0) == 0.0);
  CHECK(smooth_step(0.5) == 0.5);
  CHECK(smooth_step(1.0) == 1.0);
  CHECK(smooth_step(7.0) == 1.0);
  constexpr double h = 1e-3;
  CHECK(smooth_step(h) < 11.0 * h * h * h);  // 10 s^3 to leading order
  CHECK(1.0 - smooth_step(1.0 - h) < 11.0 * h * h * h);
  for (double s = 0.0; s < 1.0; s += 0.05) {
    CHECK(smooth_step(s + 0.05) > smooth_step(s));
    CHECK(smooth_step(s) + smooth_step(1.0 - s) == Approx(1.0));
  }
}

TEST_CASE("filling raises the pressure from zero to its end-diastolic value at resting calcium",
          "[unit][heartbeat]") {
  const Phase filling = phases({})[0];
  CHECK(filling.name == "filling");
  CHECK(filling.marks == std::string(heartbeat::end_diastole));
  CHECK(filling.loads(0.0).pressure == 0.0);
  CHECK(filling.loads(0.15).pressure == Approx(4.0 * mmHg));
  CHECK(filling.loads(0.3).pressure == 8.0 * mmHg);
  CHECK(filling.loads(2.0).pressure == 8.0 * mmHg);
  for (const double t : {0.0, 0.1, 0.5}) {
    CHECK(filling.loads(t).calcium == 0.01);
    CHECK(filling.loads(t).activation == 0.0);
  }
}

TEST_CASE("contraction begins with the loads that end filling", "[unit][heartbeat]") {
  const auto all = phases({});
  REQUIRE(all.size() == 2);
  CHECK(all[1].loads(0.0) == all[0].loads(1.0));
}

TEST_CASE("contraction raises pressure, activation and calcium to their plateaus",
          "[unit][heartbeat]") {
  const Protocol p;
  const Phase contraction = phases(p)[1];
  CHECK(contraction.marks == std::string(heartbeat::end_systole));
  CHECK(contraction.loads(0.1).pressure == Approx(79.0 * mmHg));  // half way from 8 to 150
  CHECK(contraction.loads(0.2).pressure == p.es_pressure);
  CHECK(contraction.loads(0.1).activation == Approx(0.5));
  CHECK(contraction.loads(0.2).activation == 1.0);
  CHECK(contraction.loads(0.03).calcium == p.calcium.at(0.03));
  CHECK(contraction.loads(0.06).calcium == 1.0);
  CHECK(contraction.loads(1.0).calcium == 1.0);
  CHECK(contraction.end == Phase::End::steady);
}

TEST_CASE("a calcium transient decays, and its phase ends when the cavity fills again",
          "[unit][heartbeat]") {
  Protocol transient;
  transient.calcium.mode = material::Calcium::Mode::transient;
  transient.contraction_drag = 7.0;
  const Phase contraction = phases(transient)[1];
  CHECK(contraction.loads(0.3).calcium < 0.11);  // 0.01 + 0.09
  CHECK(contraction.end == Phase::End::refilling);
  CHECK(contraction.drag == 0.0);
}

TEST_CASE("a phase ends at exactly the pressure that was asked for", "[unit][heartbeat]") {
  Protocol p;
  for (p.es_pressure = 10.0; p.es_pressure < 20.0; p.es_pressure += 0.137)
    CHECK(phases(p)[1].loads(0.3).pressure == p.es_pressure);
}

TEST_CASE("a moment's name is written as readers know it", "[unit][heartbeat]") {
  CHECK(heartbeat::title(heartbeat::end_diastole) == "end-diastole");
  CHECK(heartbeat::title(heartbeat::end_systole) == "end-systole");
  CHECK(heartbeat::title(heartbeat::mitral_opening) == "mitral opening");
}

TEST_CASE("the loads are final when the slower of pressure and calcium has arrived",
          "[unit][heartbeat]") {
  Protocol p;
  CHECK(phases(p)[0].settled == 0.3);
  CHECK(phases(p)[1].settled == 0.2);
  p.contraction_ramp = 0.01;
  CHECK(phases(p)[1].settled == 0.06);
}

TEST_CASE("a constant volume is steady after one window, not before", "[unit][heartbeat]") {
  CHECK(first_steady(0.1, 0.002, 1.0, [](double) { return 5.0; }) == Approx(0.1).margin(1.1e-3));
  SteadyVolume nothing(0.1, 0.002);
  CHECK_FALSE(nothing.reached());
  nothing.record(0.0, 5.0);
  CHECK_FALSE(nothing.reached());
}

TEST_CASE("the turning points of a swing do not look steady", "[unit][heartbeat]") {
  // 1 % either way, with periods up to twice the window
  for (const double period : {0.05, 0.1, 0.15, 0.2})
    CHECK(first_steady(0.1, 0.002, 3.0, [&](double t) {
            return 100.0 + std::cos(2.0 * M_PI * t / period);
          }) == -1.0);
}

TEST_CASE("a swing is steady once it has died down to the tolerance", "[unit][heartbeat]") {
  // range over mean is 2 % exp(-5 t) over half a period before: below 0.2 % at t = 0.46 + 0.1 s
  const double t = first_steady(0.1, 0.002, 3.0, [](double time) {
    return 100.0 + std::exp(-5.0 * time) * std::cos(2.0 * M_PI * time / 0.1);
  });
  CHECK(t > 0.46);
  CHECK(t < 0.57);
}

TEST_CASE("a slow drift is steady when a window sees less than the tolerance",
          "[unit][heartbeat]") {
  const auto drift = [](double per_window) {
    return first_steady(0.1, 0.002, 0.2,
                        [&](double t) { return 100.0 * (1.0 + per_window * t / 0.1); });
  };
  CHECK(drift(0.0025) == -1.0);
  CHECK(drift(0.0015) > 0.0);
}

TEST_CASE("what is older than the window is forgotten", "[unit][heartbeat]") {
  SteadyVolume steady(0.1, 0.002);
  for (int i = 0; i <= 300; ++i)
    steady.record(i * 1e-3, i < 100 ? 50.0 : 100.0);
  CHECK(steady.reached());
  CHECK(steady.variation() == 0.0);
  CHECK(steady.samples().size() <= 102);  // 100 steps and both ends
}
