#include "lv/heartbeat/settling.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace lv::heartbeat;

TEST_CASE("the time left of a phase is that of its ramp and windows until its loads are final",
          "[unit][heartbeat]") {
  const Phase filling = phases({}).front();
  Settling settling;
  const double unknown = std::numeric_limits<double>::infinity();
  CHECK(settling.time_left(filling, 0.1, unknown) == Approx(filling.usual - 0.1));
  // it never stands still at nothing, and never exceeds the longest duration
  CHECK(settling.time_left(filling, 1.0, unknown) > 0.0);
  CHECK(settling.time_left(filling, filling.longest - 0.001, unknown) <= 0.001);
}

TEST_CASE("a variation that falls exponentially ends the phase where it meets the tolerance",
          "[unit][heartbeat]") {
  const Phase contraction = phases({}).back();
  Settling settling;
  constexpr double rate = 6.0;  // [1/s]
  const auto variation = [&](double time) { return 0.2 * std::exp(-rate * time); };
  const double end = std::log(0.2 / contraction.tolerance) / rate;
  double left = 0.0;
  for (double time = 0.3; time < 0.5; time += 0.02)
    left = settling.time_left(contraction, time, variation(time));
  CHECK(left == Approx(end - 0.48).epsilon(0.05));
}
