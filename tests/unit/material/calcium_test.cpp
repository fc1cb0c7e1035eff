#include "lv/material/calcium.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using lv::material::Calcium;

TEST_CASE("the calcium transient peaks at Ca_max at t = tau", "[unit][material]") {
  const Calcium calcium{Calcium::Mode::transient};
  CHECK(calcium.at(0.06) == Approx(1.0).epsilon(1e-15));
  for (double t = 0.0; t < 1.0; t += 0.001)
    CHECK(calcium.at(t) <= 1.0);
}

TEST_CASE("the calcium transient follows its rate (A.1)", "[unit][material]") {
  const Calcium c{Calcium::Mode::transient, 0.02, 1.3, 0.05};
  for (const double t : {0.001, 0.02, 0.05, 0.09, 0.3}) {
    const double rate = (c.Ca_max - c.Ca_0) / c.tau * std::exp(1.0 - t / c.tau) * (1.0 - t / c.tau);
    // second-order difference with steps of 1e-5 s: (h/tau)^2 = 4e-8 of the initial rate, 64 uM/s
    CHECK((c.at(t + 1e-5) - c.at(t - 1e-5)) / 2e-5 == Approx(rate).margin(1e-5));
  }
}

TEST_CASE("the calcium transient decays to its resting level", "[unit][material]") {
  const Calcium calcium{Calcium::Mode::transient};
  CHECK(calcium.at(0.12) == Approx(0.01 + 0.99 * 2.0 / std::exp(1.0)));
  CHECK(calcium.at(1.5) == Approx(0.01).epsilon(1e-6));
}

TEST_CASE("held calcium rises like the transient and stays at its peak", "[unit][material]") {
  const Calcium hold;
  const Calcium transient{Calcium::Mode::transient};
  for (const double t : {0.0, 0.01, 0.03, 0.0599})
    CHECK(hold.at(t) == transient.at(t));
  for (const double t : {0.06, 0.1, 2.0})
    CHECK(hold.at(t) == 1.0);
}

TEST_CASE("before activation calcium rests", "[unit][material]") {
  for (const auto mode : {Calcium::Mode::hold, Calcium::Mode::transient}) {
    CHECK(Calcium{mode}.at(-1.0) == 0.01);
    CHECK(Calcium{mode}.at(0.0) == 0.01);
  }
}

TEST_CASE("a double-exponential transient peaks at Ca_max and starts from rest",
          "[unit][material]") {
  const Calcium calcium{.mode = Calcium::Mode::transient,
                        .Ca_0 = 0.1,
                        .Ca_max = 0.7,
                        .shape = Calcium::CurveShape::double_exponential};
  CHECK(calcium.at(0.0) == 0.1);
  CHECK(calcium.at(calcium.peak_time()) == Approx(0.7).epsilon(1e-14));
  for (double t = 0.0; t < 2.0; t += 0.001)
    CHECK(calcium.at(t) <= 0.7 * (1.0 + 1e-14));
  CHECK(calcium.at(3.0) == Approx(0.1).epsilon(1e-4));
}

TEST_CASE("held double-exponential calcium stays at its peak", "[unit][material]") {
  const Calcium calcium{
      .Ca_0 = 0.1, .Ca_max = 0.7, .shape = Calcium::CurveShape::double_exponential};
  CHECK(calcium.at(0.5 * calcium.peak_time()) < 0.7);
  CHECK(calcium.at(1.5 * calcium.peak_time()) == 0.7);
}
