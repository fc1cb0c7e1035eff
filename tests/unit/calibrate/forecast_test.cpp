#include "lv/calibrate/fit_parts.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

using namespace lv::calibrate;

namespace {

constexpr auto rests = Sought::rests_anew;
constexpr auto rests_again = Sought::rests_again;
constexpr auto contracts = Sought::contracts_anew;
constexpr auto contracts_again = Sought::contracts_again;
constexpr double root_found = 5e-5;

/// An equilibrium of a recorded fit: its part, kind, processor time [s] and, in brackets, misfit.
struct Found {
  const char* part;
  Sought which;
  double seconds;
  double misfit = 0.0;
};

/// Scale and tension of the default ventricle, elements of 14 mm: `ventricle calibrate` with
/// edv = "110 ml" and esv = "55 ml".
const std::vector<Found> recorded_fit{
    {"bracket of scale", rests, 0.94, std::log(144.354 / 110.0)},
    {"bracket of scale", rests, 0.14, std::log(132.166 / 110.0)},
    {"bracket of scale", rests, 0.14, std::log(108.064 / 110.0)},
    {"bracket of scale", rests, 0.08, std::log(110.076 / 110.0)},
    {"bracket of scale", rests, 0.06, 1e-6},
    {"bracket of T_scale", contracts, 1.58, std::log(58.393 / 55.0)},
    {"bracket of T_scale", contracts, 0.13, std::log(49.483 / 55.0)},
    {"bracket of T_scale", contracts, 0.13, std::log(54.912 / 55.0)},
    {"bracket of T_scale", contracts, 0.06, 1e-6},
    {"bracket of scale", rests, 0.06, 4e-5},
    {"bracket of T_scale", contracts, 0.05, 1e-6},
    {"result", rests_again, 0.07},
    {"result", contracts_again, 0.06},
    {"sensitivity", rests_again, 0.07},
    {"sensitivity", rests_again, 0.06},
    {"sensitivity", contracts_again, 0.08},
    {"sensitivity", contracts_again, 0.06},
    {"sensitivity", rests, 0.09},
    {"sensitivity", contracts_again, 0.09},
    {"sensitivity", rests, 0.07},
    {"sensitivity", contracts_again, 0.06},
    {"sensitivity", rests, 0.07},
    {"sensitivity", contracts_again, 0.07},
    {"sensitivity", rests, 0.09},
    {"sensitivity", contracts_again, 0.08},
};

Plan scale_and_tension() {
  Plan p;
  p.passive = FittedPassive::scale;
  p.active = true;
  return p;
}

/// What a forecast says after each equilibrium of the recorded fit.
template <class Say>
void follow(FitForecast& forecast, double left, const Say& say) {
  std::string part;
  for (const Found& found : recorded_fit) {
    if (found.part != part)
      forecast.begin(found.part);
    part = found.part;
    forecast.record(found.which, found.seconds);
    if (found.misfit != 0.0)
      forecast.bracket(found.misfit, root_found);
    left -= found.seconds;
    say(left);
  }
}

}  // namespace

TEST_CASE(
    "a fit says its time left from its first equilibrium on, in its last two thirds within 30%",
    "[unit][calibrate]") {
  FitForecast forecast({{1000, false, {}}});
  CHECK(forecast.seconds_left() < 0.0);
  forecast.begin_mesh(parts_of(scale_and_tension()));
  CHECK(forecast.seconds_left() < 0.0);
  double all = 0.0;
  for (const Found& found : recorded_fit)
    all += found.seconds;
  follow(forecast, all, [&](double left) {
    CHECK(forecast.seconds_left() > 0.7 * left - 0.1);
    if (left < all * 2.0 / 3.0)
      CHECK(forecast.seconds_left() < 1.3 * left + 0.1);
  });
  CHECK(forecast.seconds_left() == Approx(0.0).margin(1e-9));
}

TEST_CASE("a fit on a coarse wall says what the finer one will take besides", "[unit][calibrate]") {
  Plan coarse = scale_and_tension();
  coarse.parameters_alone = true;
  Plan fine = scale_and_tension();
  fine.starts_near = true;
  FitForecast forecast({{1000, false, parts_of(coarse)}, {4000, false, parts_of(fine)}});
  forecast.begin_mesh(parts_of(coarse));
  const auto find = [&](const char* part, std::initializer_list<std::pair<Sought, double>> all) {
    forecast.begin(part);
    for (const auto& [which, seconds] : all)
      forecast.record(which, seconds);
    forecast.expect(0.0);
  };
  find("bracket of scale", {{rests, 1.0}, {rests, 0.1}});
  find("bracket of T_scale", {{contracts, 1.6}, {contracts, 0.09}});
  find("result", {{rests_again, 0.07}, {contracts_again, 0.075}});
  const double others = 6 * 0.1 + 1.6 + 3 * 0.09 + 3 * 0.07 + 7 * 0.075;
  CHECK(forecast.seconds_left() == Approx((1.0 + others) * std::pow(4.0, 1.3)).epsilon(1e-6));
  forecast.begin_mesh(parts_of(fine));
  forecast.begin("bracket of scale");
  forecast.record(rests, 3.0);  // less than the number of nodes let expect
  CHECK(forecast.seconds_left() == Approx(3.0 * others).epsilon(1e-6));
}

TEST_CASE("on the same mesh again a fit knows what equilibria take", "[unit][calibrate]") {
  const std::vector<FitPart> trials{{"trials", {1, 1, 0, 0}, 6.0}};
  FitForecast forecast({{1000, true, trials}, {1000, true, trials}});
  const auto begin = [&] {
    forecast.begin_mesh(trials);
    forecast.begin("trials");
  };
  begin();
  for (int i = 0; i < 6; ++i) {
    forecast.record(rests, 1.0);
    forecast.record(rests_again, 0.1);
  }
  CHECK(forecast.seconds_left() == Approx(6.6));
  begin();
  forecast.record(rests, 2.0);  // from afar
  CHECK(forecast.seconds_left() == Approx(5.6));
  forecast.record(rests_again, 0.4);
  CHECK(forecast.seconds_left() == Approx(5.5));
}

TEST_CASE("a fit to Klotz's curve unloads no wall again once it has a tension",
          "[unit][calibrate]") {
  Plan plan;
  plan.passive = FittedPassive::klotz;
  plan.active = plan.parameters_alone = true;
  const std::vector<FitPart> parts = parts_of(plan);
  REQUIRE(parts.back().name == of_result);
  std::size_t tensions = 0;
  for (const FitPart& part : parts) {
    if (tensions > 0)
      CHECK(part.trials * (part.each[0] + part.each[2]) == 0.0);
    tensions += part.name == bracket_of("T_scale") ? 1 : 0;
  }
  CHECK(tensions == 2);
}

TEST_CASE("what is seldom and long does not tell the rest of a fit", "[unit][calibrate]") {
  FitForecast forecast({{1000, false, {}}});
  forecast.begin_mesh({{"trials", {1, 0, 0, 0}, 20.0}});
  forecast.begin("trials");
  forecast.record(rests, 1.0);
  const double before = forecast.seconds_left();
  forecast.record(rests, 5.0);  // a wall that gave way
  forecast.record(rests, 0.1);
  forecast.record(rests, 0.1);
  CHECK(forecast.seconds_left() < before);
}

TEST_CASE("answers of a fit that was stopped tell nothing of its speed", "[unit][calibrate]") {
  FitForecast forecast({{1000, false, {}}});
  forecast.begin_mesh(parts_of(scale_and_tension()));
  forecast.begin("bracket of scale");
  for (int i = 0; i < 4; ++i)
    forecast.record(rests, 1e-5);
  CHECK(forecast.seconds_left() < 0.0);
}
