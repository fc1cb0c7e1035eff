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
const double first_step = std::log(1.5);
constexpr double pace = 0.05;  // of made-up fits [s per tangent]

/// An equilibrium of a recorded fit: its part, kind, processor time [s], tangents and, in brackets,
/// misfit.
struct Found {
  const char* part;
  Sought which;
  double seconds, tangents;
  double misfit = 0.0;
};

Effort effort(double seconds, double tangents) {
  return {seconds, {tangents, 0.0}};
}

/// Scale and tension of the default ventricle, elements of 14 mm: `ventricle calibrate` with
/// edv = "110 ml" and esv = "55 ml".
const std::vector<Found> recorded_fit{
    {"bracket of scale", rests, 1.10, 19.9, std::log(144.354 / 110.0)},
    {"bracket of scale", rests, 0.15, 2.5, std::log(132.056 / 110.0)},
    {"bracket of scale", rests, 0.17, 2.8, std::log(107.688 / 110.0)},
    {"bracket of scale", rests, 0.09, 1.4, std::log(110.091 / 110.0)},
    {"bracket of scale", rests, 0.08, 1.2, std::log(110.000 / 110.0)},
    {"bracket of T_scale", contracts, 1.36, 25.4, std::log(58.369 / 55.0)},
    {"bracket of T_scale", contracts, 0.13, 2.5, std::log(49.448 / 55.0)},
    {"bracket of T_scale", contracts, 0.14, 2.6, std::log(54.914 / 55.0)},
    {"bracket of T_scale", contracts, 0.07, 1.2, std::log(55.000 / 55.0)},
    {"bracket of scale", rests_again, 0.07, 1.1, std::log(109.995 / 110.0)},
    {"bracket of T_scale", contracts_again, 0.07, 1.1, std::log(55.000 / 55.0)},
    {"result", rests_again, 0.06, 1.1},
    {"result", contracts_again, 0.07, 1.1},
    {"sensitivity", rests_again, 0.10, 1.8},
    {"sensitivity", rests_again, 0.09, 1.8},
    {"sensitivity", contracts_again, 0.08, 1.4},
    {"sensitivity", contracts_again, 0.07, 1.4},
    {"sensitivity", rests, 0.07, 1.2},
    {"sensitivity", contracts_again, 0.07, 1.2},
    {"sensitivity", rests, 0.08, 1.3},
    {"sensitivity", contracts_again, 0.06, 1.2},
    {"sensitivity", rests, 0.07, 1.2},
    {"sensitivity", contracts_again, 0.06, 1.2},
    {"sensitivity", rests, 0.06, 1.1},
    {"sensitivity", contracts_again, 0.06, 1.3},
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
    forecast.record(found.which, effort(found.seconds, found.tangents));
    if (std::string(found.part).rfind("bracket", 0) == 0)
      forecast.bracket(found.misfit, root_found, first_step);
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
    for (const auto& [which, tangents] : all)
      forecast.record(which, effort(pace * tangents, tangents));
    forecast.expect(0.0);
  };
  find("bracket of scale", {{rests, 20.0}, {rests, 2.0}});
  find("bracket of T_scale", {{contracts, 32.0}, {contracts, 1.8}});
  find("result", {{rests_again, 1.2}, {contracts_again, 1.2}});
  const double others = 6 * 2.0 + 32.0 + 3 * 1.8 + 3 * 1.2 + 7 * 1.2;
  CHECK(forecast.seconds_left() == Approx((20.0 + others) * pace * std::pow(4.0, 1.3)));
  forecast.begin_mesh(parts_of(fine));
  forecast.begin("bracket of scale");
  const double slower = 0.15;                 // less than the number of nodes let expect
  forecast.record(rests, effort(9.0, 60.0));  // steps failed: that says nothing of the others
  CHECK(forecast.seconds_left() == Approx(slower * others));
}

TEST_CASE("muscle that a coarse wall was loaded from nothing with again tells what that takes",
          "[unit][calibrate]") {
  const std::vector<FitPart> trials{{"trials", {1, 0, 0, 0}, 3.0}};
  FitForecast forecast({{1000, false, trials}, {1000, false, trials}, {2000, false, trials}});
  forecast.begin_mesh(trials);
  forecast.begin("trials");
  for (const double tangents : {20.0, 2.0, 40.0})
    forecast.record(rests, effort(pace * tangents, tangents));
  forecast.begin_mesh(trials);
  CHECK(forecast.seconds_left() ==
        Approx(pace * (40.0 + 2 * 2.0) * (1.0 + std::pow(2.0, 1.3))).epsilon(1e-6));
}

TEST_CASE("fixed points that follow the inverse problem are not expected of finer walls",
          "[unit][calibrate]") {
  const std::vector<FitPart> trials{{"trials", {1, 0, 0, 0}, 3.0}};
  const auto seconds_left = [&](double of_fixed_points) {
    FitForecast forecast({{1000, true, trials}, {2000, true, trials}});
    forecast.begin_mesh(trials);
    forecast.begin("trials");
    for (const double tangents : {36.0, 24.0, 24.0})
      forecast.record(rests, {pace * tangents, {tangents, of_fixed_points}});
    return forecast.seconds_left() / (pace * std::pow(2.0, 1.3));
  };
  CHECK(seconds_left(12.0) == Approx(9.0 + 2 * 6.0));
  CHECK(seconds_left(0.0) == Approx(3 * 24.0));
}

TEST_CASE("an equilibrium on its way has the less left the more of the loads is on",
          "[unit][calibrate]") {
  FitForecast forecast({{1000, false, {}}});
  forecast.begin_mesh({{"trials", {1, 0, 0, 0}, 2.0}});
  forecast.begin("trials");
  CHECK(forecast.seconds_left() < 0.0);
  const double first = 1.0 / 3.0;
  forecast.on_the_way(rests, effort(0.5, 10.0), first);
  CHECK(forecast.seconds_left() == Approx(pace * (0.5 * 19.0 + 2.0)));
  forecast.on_the_way(rests, effort(2.0, 40.0), first * (std::pow(4.0, 0.8) - 1.0));
  // more than usual by now
  CHECK(forecast.seconds_left() == Approx(pace * (0.2 * 40.0 + 2.0)));
  forecast.record(rests, effort(2.5, 50.0));
  CHECK(forecast.seconds_left() == Approx(pace * 2.0));
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
    forecast.record(rests, effort(1.0, 10.0));
    forecast.record(rests_again, effort(0.1, 1.0));
  }
  CHECK(forecast.seconds_left() == Approx(6.6));
  begin();
  forecast.record(rests, effort(2.0, 20.0));  // from afar
  CHECK(forecast.seconds_left() == Approx(5.6));
  forecast.record(rests_again, effort(0.4, 4.0));
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
  forecast.record(rests, effort(1.0, 20.0));
  const double before = forecast.seconds_left();
  forecast.record(rests, effort(5.0, 100.0));  // a wall that gave way
  forecast.record(rests, effort(0.1, 2.0));
  forecast.record(rests, effort(0.1, 2.0));
  CHECK(forecast.seconds_left() < before);
}

TEST_CASE("answers of a fit that was stopped tell nothing of its speed", "[unit][calibrate]") {
  FitForecast forecast({{1000, false, {}}});
  forecast.begin_mesh(parts_of(scale_and_tension()));
  forecast.begin("bracket of scale");
  for (int i = 0; i < 4; ++i)
    forecast.record(rests, effort(1e-5, 0.0));
  CHECK(forecast.seconds_left() < 0.0);
}
