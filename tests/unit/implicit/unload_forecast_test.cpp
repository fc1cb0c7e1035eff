#include "lv/implicit/unload_forecast.hpp"

#include <catch2/catch.hpp>

using lv::implicit::PathForecast;
using lv::implicit::UnloadForecast;

TEST_CASE("the equilibria left of an unloading follow from how the distance falls",
          "[unit][implicit]") {
  // tests/regress/kills.py, the first unloading: distances [mm], tolerance 0.01 mm
  UnloadForecast forecast(0.02 * 0.01);
  double left = 5.0;
  for (const double distance : {6.7215, 1.7572, 0.2287, 0.0222, 0.0017}) {
    forecast.accepted(distance);
    CHECK(forecast.equilibria_left() == Approx(left).margin(1.0));
    left -= 1.0;
  }
  forecast.accepted(0.0002);
  CHECK(forecast.equilibria_left() == 0.0);
}

TEST_CASE("the time left of an unloading is known to a factor of two", "[unit][implicit]") {
  // the default mesh under 8 mmHg: seconds of each equilibrium, and distance [mm]
  UnloadForecast forecast(2e-4);
  double left = 18.7 + 12.8 + 3.57 + 3.68 + 4.0 + 2.52;
  const auto find = [&](double seconds, double distance) {
    forecast.sought(seconds);
    forecast.accepted(distance);
    left -= seconds;
  };
  CHECK(forecast.seconds_left() < 0.0);
  find(18.7, 13.0291);
  CHECK(forecast.seconds_left() == Approx(left).epsilon(0.3));
  find(12.8, 4.8358);
  CHECK(forecast.seconds_left() == Approx(left).epsilon(0.5));
  find(3.57, 1.0499);
  CHECK(forecast.seconds_left() == Approx(left).epsilon(1.0));
  find(3.68, 0.3039);
  find(4.0, 0.0900);
  find(2.52, 0.0494);  // hardly falls
  CHECK(forecast.equilibria_left() == UnloadForecast::patience);
  forecast.begin();
  CHECK(forecast.seconds_left() < 0.0);
}

TEST_CASE("equilibria of an unloading that was stopped tell nothing of its speed",
          "[unit][implicit]") {
  UnloadForecast forecast(2e-4);
  forecast.sought(1e-6);
  forecast.accepted(1.0);
  CHECK(forecast.seconds_left() < 0.0);
}

TEST_CASE("the time left of a path along the pressure is that of its tangents",
          "[unit][implicit]") {
  // the default mesh under 8 mmHg: six steps, then loaded again [s]
  PathForecast forecast;
  CHECK(forecast.seconds_left(6.0) < 0.0);
  double left = 0.66 + 0.64 + 0.64 + 0.64 + 0.85 + 0.71;
  forecast.spent(1.51, 2);
  CHECK(forecast.seconds_left(5.0) == Approx(left).epsilon(0.3));
  double steps = 5.0;
  for (const double seconds : {0.66, 0.64, 0.64, 0.64}) {
    forecast.spent(seconds, 1);
    left -= seconds;
    CHECK(forecast.seconds_left(--steps) == Approx(left).epsilon(0.3));
  }
}

TEST_CASE("a search by fixed points that begins near its end has no long equilibria before it",
          "[unit][implicit]") {
  UnloadForecast forecast(2e-4);
  forecast.begin(true);
  forecast.sought(0.12);
  forecast.accepted(0.0807);
  CHECK(forecast.seconds_left() == Approx(4 * 0.12).epsilon(0.3));
  forecast.sought(0.12);
  forecast.sought(0.13);
  forecast.accepted(0.0616, 2);  // hardly falls, and two such equilibria are enough
  CHECK(forecast.seconds_left() == Approx(2 * 0.12).epsilon(0.1));
}
