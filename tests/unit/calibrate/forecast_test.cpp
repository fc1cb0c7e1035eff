#include "lv/calibrate/forecast.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace lv::calibrate;

namespace {

constexpr auto rests = MuscleState::rests;
constexpr auto contracts = MuscleState::contracts;
constexpr double root_found = 1e-4;

/// An equilibrium of a recorded fit: its part, muscle, processor time [s] and, in brackets, misfit.
struct Found {
  int part;
  MuscleState muscle;
  double seconds;
  double misfit = 0.0;
};

/// Scale and tension of the default ventricle, elements of 14 mm: `ventricle calibrate` with
/// edv = "110 ml" and esv = "55 ml".
const std::vector<Found> recorded_fit{
    {0, rests, 0.94, std::log(144.354 / 110.0)},
    {0, rests, 0.14, std::log(132.166 / 110.0)},
    {0, rests, 0.14, std::log(108.064 / 110.0)},
    {0, rests, 0.08, std::log(110.076 / 110.0)},
    {0, rests, 0.06, 1e-6},
    {1, contracts, 1.58, std::log(58.393 / 55.0)},
    {1, contracts, 0.13, std::log(49.483 / 55.0)},
    {1, contracts, 0.13, std::log(54.912 / 55.0)},
    {1, contracts, 0.06, 1e-6},
    {2, rests, 0.06, 4e-5},
    {3, contracts, 0.05, 1e-6},
    {4, rests, 0.07},
    {4, contracts, 0.06},
    {5, rests, 0.07},
    {5, rests, 0.06},
    {5, rests, 0.08},
    {5, rests, 0.06},
    {5, rests, 0.09},
    {5, rests, 0.09},
    {5, contracts, 0.07},
    {5, contracts, 0.06},
    {5, contracts, 0.07},
    {5, contracts, 0.07},
    {5, contracts, 0.09},
    {5, contracts, 0.08},
};

std::vector<FitPart> parts() {
  return {{FitEnd::by_misfit, false, {5.0, 0.0}}, {FitEnd::by_misfit, false, {0.0, 5.0}},
          {FitEnd::by_misfit, true, {2.0, 0.0}},  {FitEnd::by_misfit, true, {0.0, 2.0}},
          {FitEnd::counted, true, {1.0, 1.0}},    {FitEnd::counted, true, {6.0, 6.0}}};
}

/// What a forecast says after each equilibrium of the recorded fit.
template <class Say>
void follow(const Say& say) {
  FitForecast forecast(parts());
  double left = 0.0;
  for (const Found& found : recorded_fit)
    left += found.seconds;
  auto equilibria = static_cast<double>(recorded_fit.size());
  int part = -1;
  for (const Found& found : recorded_fit) {
    if (found.part != part)
      forecast.begin();
    part = found.part;
    forecast.record(found.muscle, found.seconds);
    if (found.misfit != 0.0)
      forecast.misfit(found.misfit, root_found);
    left -= found.seconds;
    equilibria -= 1.0;
    say(forecast, left, equilibria);
  }
}

}  // namespace

TEST_CASE("a fit says its time left when it knows it, within 30%", "[unit][calibrate]") {
  int said = 0;
  follow([&](const FitForecast& forecast, double left, double equilibria) {
    if (forecast.seconds_left() < 0.0)
      return;
    ++said;
    if (equilibria >= 4.0 && equilibria <= 15.0)  // the last two thirds of what is not the first
      CHECK(forecast.seconds_left() == Approx(left).epsilon(0.3));
  });
  CHECK(said == 19);
}

TEST_CASE("a fit that has not seen contracting muscle twice says how many equilibria are left",
          "[unit][calibrate]") {
  follow([&](const FitForecast& forecast, double, double equilibria) {
    const auto left = forecast.left();
    CHECK(left[0] + left[1] == Approx(equilibria).epsilon(0.3).margin(1.0));
    if (equilibria >= 19.0)
      CHECK_THAT(forecast.words(), Catch::Matchers::EndsWith(" equilibria left"));
  });
}

TEST_CASE("answers of a fit that was stopped tell nothing of its speed", "[unit][calibrate]") {
  FitForecast forecast(parts());
  forecast.begin();
  for (int i = 0; i < 4; ++i)
    forecast.record(rests, 1e-5);
  CHECK(forecast.seconds_left() < 0.0);
}

TEST_CASE("a fit whose number of corrections is not known says the least", "[unit][calibrate]") {
  FitForecast forecast({{FitEnd::by_misfit, false, {5.0, 0.0}},
                        {FitEnd::open, true, {15.0, 0.0}},
                        {FitEnd::counted, true, {8.0, 0.0}}});
  forecast.begin();
  for (int i = 0; i < 2; ++i)
    forecast.record(rests, 2.0);
  CHECK(forecast.words() == ", at least 26 equilibria left");
  forecast.begin();
  for (int i = 0; i < 20; ++i)
    forecast.record(rests, 1.0);
  CHECK(forecast.words() == ", at least 9 equilibria left");
  forecast.begin();
  CHECK(forecast.seconds_left() > 0.0);
}
