#include "lv/calibrate/fit_parts.hpp"

#include <catch2/catch.hpp>

#include <cmath>
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

/// What a forecast says after each equilibrium of the recorded fit, each of which takes so many
/// times its seconds.
template <class Say>
void follow(double slower, FitForecast& forecast, const Say& say) {
  double left = 0.0;
  for (const Found& found : recorded_fit)
    left += slower * found.seconds;
  std::string part;
  for (const Found& found : recorded_fit) {
    if (found.part != part)
      forecast.begin(found.part);
    part = found.part;
    forecast.record(found.which, slower * found.seconds);
    if (found.misfit != 0.0)
      forecast.bracket(found.misfit, root_found);
    left -= slower * found.seconds;
    say(left);
  }
}

}  // namespace

TEST_CASE("a fit says its time left from its first equilibrium on, within 30%",
          "[unit][calibrate]") {
  FitForecast forecast({{1000, false, {}}});
  CHECK(forecast.seconds_left() < 0.0);
  forecast.begin_mesh(parts_of(scale_and_tension()));
  CHECK(forecast.seconds_left() < 0.0);
  follow(1.0, forecast, [&](double left) {
    CHECK(forecast.seconds_left() == Approx(left).epsilon(0.3).margin(0.1));
  });
  CHECK(forecast.seconds_left() == 0.0);
}

TEST_CASE("a fit on a coarse wall says what the finer one will take besides", "[unit][calibrate]") {
  Plan coarse = scale_and_tension();
  coarse.parameters_alone = true;
  Plan fine = scale_and_tension();
  fine.starts_near = true;
  FitForecast forecast({{1000, false, parts_of(coarse)}, {4000, false, parts_of(fine)}});
  forecast.begin_mesh(parts_of(coarse));
  const auto found = [&](const char* part, std::vector<Sought> equilibria, double seconds) {
    forecast.begin(part);
    for (const Sought which : equilibria)
      forecast.record(which, seconds);
    forecast.expect(0.0);
  };
  found("bracket of scale", {rests, rests}, 1.0);
  found("bracket of T_scale", {contracts, contracts}, 1.0);
  found("result", {rests_again, contracts_again}, 1.0);
  const double equilibria = 2 + 3 + 1 + 1 + 2 + 4 + 8;
  CHECK(forecast.seconds_left() == Approx(equilibria * std::pow(4.0, 1.3)).epsilon(0.01));
  forecast.begin_mesh(parts_of(fine));
  forecast.begin("bracket of scale");
  forecast.record(rests, 3.0);  // faster than the number of nodes let expect
  CHECK(forecast.seconds_left() == Approx(3.0 * (equilibria - 1.0)).epsilon(0.01));
}

TEST_CASE("answers of a fit that was stopped tell nothing of its speed", "[unit][calibrate]") {
  FitForecast forecast({{1000, false, {}}});
  forecast.begin_mesh(parts_of(scale_and_tension()));
  forecast.begin("bracket of scale");
  for (int i = 0; i < 4; ++i)
    forecast.record(rests, 1e-5);
  CHECK(forecast.seconds_left() < 0.0);
}
