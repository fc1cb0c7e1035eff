#include "lv/heartbeat/settling.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lv::heartbeat;

namespace {

/// What a phase has recorded of a volume [mm^3] until `time` after its start.
template <class Volume>
SteadyVolume recorded(const Phase& phase, double time, const Volume& volume) {
  constexpr double every = 1e-3;
  SteadyVolume steady(phase.window, phase.tolerance);
  for (int i = 0; i * every <= time; ++i)
    steady.record(i * every, volume(i * every));
  return steady;
}

constexpr double forever = 60.0;

}  // namespace

TEST_CASE("the time left of a phase is that of its usual duration until that has passed",
          "[unit][heartbeat]") {
  const Phase filling = phases({}).front();
  const auto rises = [](double time) { return 7e4 * (1.0 + time); };
  CHECK(settling_time_left(filling, 0.1, recorded(filling, 0.1, rises)) ==
        Approx(filling.usual - 0.1));
  CHECK(settling_time_left(filling, 0.0, SteadyVolume(filling.window, filling.tolerance)) ==
        Approx(filling.usual));
  // it never stands still at nothing, and never exceeds the longest duration
  CHECK(settling_time_left(filling, 1.5, recorded(filling, 1.5, rises)) > 0.0);
  const double last = filling.longest - 0.001;
  CHECK(settling_time_left(filling, last, recorded(filling, last, rises)) <= 0.0011);
}

TEST_CASE("a volume that comes to rest exponentially ends the phase where it meets the tolerance",
          "[unit][heartbeat]") {
  Phase contraction = phases({}).back();
  contraction.longest = forever;
  constexpr double rate = 2.0;  // [1/s]
  const auto volume = [](double time) { return 6e4 * (1.0 + 0.5 * std::exp(-rate * time)); };
  const double window = contraction.window;
  // 0.5 (exp(rate window) - 1) exp(-rate t) = tolerance
  const double end = std::log(0.5 * (std::exp(rate * window) - 1.0) / contraction.tolerance) / rate;
  for (const double time : {0.7 * end, 0.9 * end}) {
    REQUIRE(time > contraction.usual);
    CHECK(settling_time_left(contraction, time, recorded(contraction, time, volume)) ==
          Approx(end - time).epsilon(0.1));
  }
}

TEST_CASE("a volume that was elsewhere within the window has to stay for the rest of it",
          "[unit][heartbeat]") {
  Phase contraction = phases({}).back();
  contraction.longest = forever;
  constexpr double jump = 5.0;
  const auto volume = [](double time) { return time < jump ? 5e4 : 6e4; };
  for (const double since : {0.05, 0.1, 0.2})
    CHECK(settling_time_left(contraction, jump + since,
                             recorded(contraction, jump + since, volume)) ==
          Approx(contraction.window - since).margin(2e-3));
}

TEST_CASE("a wall that was filled sooner than usual is expected to contract sooner",
          "[unit][heartbeat]") {
  const auto all = phases({});
  const Phase& filling = all.front();
  const Phase& contraction = all.back();
  const auto after = [&](double took) { return usual_after_filling(contraction, filling, took); };
  CHECK(after(filling.usual) == Approx(contraction.usual));
  CHECK(after(2.0 * filling.usual) == Approx(contraction.usual));
  const double least = contraction.ramp + contraction.window;
  CHECK(after(0.5 * (filling.usual + filling.ramp + filling.window)) ==
        Approx(0.5 * (contraction.usual + least)));
  CHECK(after(0.1) == Approx(least));
}
