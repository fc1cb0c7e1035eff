#include "lv/circulation/valve.hpp"

#include <catch2/catch.hpp>

namespace {

using namespace lv::circulation;
using lv::units::mmHg;

constexpr double open = 0.01 * resistance;

}  // namespace

TEST_CASE("a valve's flow never falls with the pressure across it, nor does its slope",
          "[unit][circulation]") {
  const Valve valve(open, {.smoothing = 0.1 * mmHg});
  const double h = 1e-3 * mmHg;
  for (double x = -0.2 * mmHg; x < 0.2 * mmHg; x += h) {
    const double slope = (valve.flow(x + h) - valve.flow(x)) / h;
    const double next = (valve.flow(x + 2 * h) - valve.flow(x + h)) / h;
    CHECK(slope > 0.0);
    CHECK(next >= slope * (1.0 - 1e-9));
  }
}

TEST_CASE("a valve is continuous with its slope where it has opened and where it has closed",
          "[unit][circulation]") {
  const ValveParameters p{.smoothing = 0.1 * mmHg};
  const Valve valve(open, p);
  constexpr double h = 1e-9;  // over which the slope changes by 4e-8 of that of an open valve
  for (const auto& [x, R] : {std::pair{0.05 * mmHg, open}, {-0.05 * mmHg, p.closed_resistance}}) {
    CHECK(valve.flow(x) == Approx(x / R).epsilon(1e-12));
    CHECK((valve.flow(x + h) - valve.flow(x)) / h == Approx(1.0 / R).margin(1e-6 / open));
    CHECK((valve.flow(x) - valve.flow(x - h)) / h == Approx(1.0 / R).margin(1e-6 / open));
  }
}

TEST_CASE("both laws have the resistances of an open and of a closed valve far from zero",
          "[unit][circulation]") {
  for (const ValveLaw law : {ValveLaw::quadratic, ValveLaw::arctangent}) {
    const ValveParameters p{.law = law};
    const Valve valve(open, p);
    const double x = 1000.0 * mmHg;  // the arctangent is slow
    CHECK(valve.flow(x) == Approx(x / open).epsilon(1e-3));
    CHECK(valve.flow(-x) == Approx(-x / p.closed_resistance).epsilon(1e-3));
  }
}
