#include "lv/calibrate/fit.hpp"

#include "lv/base/check.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/klotz.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

namespace {

using namespace lv::calibrate;
using lv::quasi_static::Loads;
using lv::units::mmHg;

constexpr double V_0 = 70e3;

/// A cavity whose volume is known in closed form: it fills by a power of pressure over stiffness,
/// like Klotz's curve for exponent = 1, and contraction takes its share away.
double volume(const Parameters& p, const Loads& loads) {
  const double filling = 40e3 * std::pow(loads.pressure / (p.C_a * p.scale), p.exponent / 2.76);
  return (V_0 + filling) / (1.0 + 0.8 * loads.activation * p.T_scale);
}

Plan plan() {
  Plan p;
  p.ed_pressure = 8.0 * mmHg;
  p.es_pressure = 120.0 * mmHg;
  p.unloaded_volume = V_0;
  p.tolerance = 0.01;
  p.stiffness = {0.05, 50.0};
  p.exponent = {0.2, 5.0};
  p.T_scale = {0.1, 20.0};
  p.edv.origin = "case.toml:3";
  p.esv.origin = "case.toml:4";
  return p;
}

/// To find C_a and T_scale from the volumes that these make.
Plan plan_for(const Parameters& truth) {
  Plan p = plan();
  p.passive = Passive::C_a;
  p.active = true;
  p.edv.volume = volume(truth, {p.ed_pressure, 0.0});
  p.esv.volume = volume(truth, {p.es_pressure, 1.0});
  return p;
}

}  // namespace

TEST_CASE("C_a and T_scale that made the volumes are found", "[calibrate]") {
  const Parameters truth{.C_a = 7.5, .T_scale = 5.5};
  const Plan p = plan_for(truth);
  const Fit found = fit(volume, {.C_a = 1.0, .T_scale = 3.0}, p);
  CHECK(found.parameters.C_a == Approx(truth.C_a).epsilon(1e-3));
  CHECK(found.parameters.T_scale == Approx(truth.T_scale).epsilon(1e-3));
  CHECK(found.edv == Approx(p.edv.volume).epsilon(1e-4));
  CHECK(found.esv == Approx(p.esv.volume).epsilon(1e-4));
  CHECK(found.history.front().purpose == "bracket of C_a");
  CHECK(found.history.front().parameters.C_a == 1.0);
}

TEST_CASE("a fit says how it moves with the measurements", "[calibrate]") {
  const Parameters truth{.C_a = 7.5, .T_scale = 5.5};
  const Plan p = plan_for(truth);
  const Sensitivity s = fit(volume, truth, p).sensitivity;

  Plan moved = p;  // by fitting again
  moved.tolerance = 1e-6;
  moved.edv.volume *= 1.001;
  const Parameters by_edv = fit(volume, truth, moved).parameters;
  CHECK(s.by_data(0, 0) == Approx(std::log(by_edv.C_a / truth.C_a) / 1e-3).epsilon(0.01));
  CHECK(s.by_data(1, 0) == Approx(std::log(by_edv.T_scale / truth.T_scale) / 1e-3).epsilon(0.01));

  moved.edv.volume = p.edv.volume;
  moved.ed_pressure *= 1.001;
  const double dp = 1e-3 * p.ed_pressure;
  const Parameters by_p = fit(volume, truth, moved).parameters;
  CHECK(s.by_data(0, 2) == Approx(std::log(by_p.C_a / truth.C_a) / dp).epsilon(0.01));
  CHECK(s.by_data(1, 2) == Approx(std::log(by_p.T_scale / truth.T_scale) / dp).epsilon(0.01));
  CHECK(s.by_data(0, 1) == Approx(0.0).margin(1e-9));  // ESV says nothing about C_a
}

TEST_CASE("scale and exponent are found from the end-diastolic point and the Klotz curve",
          "[calibrate]") {
  Plan p = plan();
  p.passive = Passive::scale_and_exponent;
  p.edv.volume = volume({.scale = 3.0}, {p.ed_pressure, 0.0});
  const Fit found = fit(volume, {.scale = 1.0, .exponent = 1.6}, p);
  CHECK(found.parameters.scale == Approx(3.0).epsilon(1e-3));
  CHECK(found.parameters.exponent == Approx(1.0).epsilon(1e-3));
  CHECK(found.sensitivity.parameters.size() == 2);
  CHECK(std::abs(found.sensitivity.correlation(0, 1)) < 1.0);
}

TEST_CASE("a volume out of reach is refused with the volumes within reach", "[calibrate]") {
  Plan p = plan();
  p.passive = Passive::C_a;
  p.edv.volume = 65e3;  // below the unloaded volume
  const double least = 1e-3 * volume({.C_a = 50.0}, {p.ed_pressure, 0.0});
  const double most = 1e-3 * volume({.C_a = 0.05}, {p.ed_pressure, 0.0});
  using Catch::Matchers::Contains;
  CHECK_THROWS_AS(fit(volume, {}, p), lv::InputError);
  CHECK_THROWS_WITH(fit(volume, {}, p),
                    Contains("case.toml:3: 65.00 ml cannot be reached") &&
                        Contains(fmt::format("{:.2f} ml at C_a = 0.05", most)) &&
                        Contains(fmt::format("{:.2f} ml at 50", least)));
}

TEST_CASE("the bracket keeps away from where the model has no equilibrium", "[calibrate]") {
  Plan p = plan();
  p.passive = Passive::C_a;
  p.edv.volume = volume({.C_a = 0.72}, {p.ed_pressure, 0.0});
  const auto fragile = [](const Parameters& q, const Loads& loads) {
    if (q.C_a < 0.7)
      throw lv::RunError("no equilibrium", "");
    return volume(q, loads);
  };
  CHECK(fit(fragile, {}, p).parameters.C_a == Approx(0.72).epsilon(1e-3));
}
