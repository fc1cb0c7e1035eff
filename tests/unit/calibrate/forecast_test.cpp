#include "lv/calibrate/forecast.hpp"

#include <catch2/catch.hpp>

using namespace lv::calibrate;

TEST_CASE("the time left of a fit is that of the equilibria of the parts that are left",
          "[unit][calibrate]") {
  FitForecast forecast({{"bracket", {4.0, 0.0}}, {"bracket", {0.0, 3.0}}, {"result", {1.0, 1.0}}});
  forecast.begin();
  CHECK(forecast.seconds_left() < 0.0);
  forecast.record(MuscleState::rests, 30.0);  // the first, from afar
  for (int i = 0; i < 2; ++i)
    forecast.record(MuscleState::rests, 2.0);
  // one of this part and one of the result at rest, four of contracting muscle at a guess
  CHECK(forecast.seconds_left() == Approx(2.0 * 2.0 + 4.0 * 2.0 * 2.0));
  for (int i = 0; i < 5; ++i)  // more than usual: it is taken to end soon
    forecast.record(MuscleState::rests, 2.0);
  CHECK(forecast.seconds_left() == Approx(2.0 * 2.0 + 4.0 * 2.0 * 2.0));
  forecast.begin();
  for (int i = 0; i < 3; ++i)
    forecast.record(MuscleState::contracts, 5.0);
  forecast.begin();
  CHECK(forecast.seconds_left() == Approx(2.0 + 5.0));
}
