#include "lv/implicit/unload_forecast.hpp"

#include <catch2/catch.hpp>

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

TEST_CASE("the time left of an unloading is that of equilibria near others", "[unit][implicit]") {
  UnloadForecast forecast(2e-4);
  forecast.sought(3.0, false);  // from no load
  forecast.accepted(1.0);
  CHECK(forecast.seconds_left() < 0.0);
  CHECK(forecast.words() == ", 4 equilibria left");
  forecast.sought(0.2, true);
  forecast.accepted(0.1);
  CHECK(forecast.seconds_left() == Approx(3.0 * 0.2));
  forecast.accepted(0.08);  // hardly falls
  CHECK(forecast.seconds_left() < 0.0);
  CHECK(forecast.words().empty());
  forecast.begin();
  forecast.accepted(2e-5);
  CHECK(forecast.seconds_left() == 0.0);
}
