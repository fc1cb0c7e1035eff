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

TEST_CASE("a wall that swings back while it is filled, or rests soon, is expected to rest sooner",
          "[unit][heartbeat]") {
  const auto all = phases({});
  const auto least = [](const Phase& phase) { return phase.ramp + phase.window; };
  const auto expected_shares = [&](const Beat& beat) {
    std::vector<double> shares;
    const auto expected = phases_of_wall(all, beat);
    for (std::size_t i = 0; i < all.size(); ++i)
      shares.push_back((expected[i].usual - least(all[i])) / (all[i].usual - least(all[i])));
    return shares;
  };
  const auto while_filled = [&](const std::vector<double>& volumes) {
    Beat beat;
    for (const double volume : volumes)
      beat.curves.push_back({.volume = volume});
    return expected_shares(beat);
  };
  const auto filled_in = [&](double share) {
    Beat beat;
    beat.moments.push_back({.name = all.front().marks});
    beat.moments.back().wall.time = std::lerp(least(all.front()), all.front().usual, share);
    return expected_shares(beat).back();
  };
  for (const std::size_t i : {0u, 1u}) {
    CHECK(while_filled({})[i] == Approx(1.0));
    CHECK(while_filled({70.0, 80.0, 90.0, 89.95})[i] == Approx(1.0));
    CHECK(while_filled({70.0, 80.0, 79.0})[i] == Approx(1.0 / 3.0));
  }
  CHECK(filled_in(0.2) == Approx(1.0 / 3.0));
  CHECK(filled_in(1.0 / 3.0) == Approx(1.0 / 3.0));
  CHECK(filled_in(0.5) == Approx(2.0 / 3.0));
  CHECK(filled_in(0.7) == Approx(1.0));
  CHECK(filled_in(2.0) == Approx(1.0));
}
