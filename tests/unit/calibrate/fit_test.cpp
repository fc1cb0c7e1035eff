#include "lv/calibrate/fit.hpp"

#include "lv/base/check.hpp"
#include "lv/base/units.hpp"
#include "lv/calibrate/fit_out_of_reach.hpp"
#include "lv/calibrate/klotz.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace {

using namespace lv::calibrate;
using lv::solid::Loads;
using lv::units::mmHg;

constexpr double V_0 = 70e3;

/// A cavity whose volume is known in closed form: it fills by a power of pressure over stiffness,
/// like Klotz's curve for exponent = 1, and contraction takes its share away.
double volume(const FitParameters& p, const Loads& loads) {
  const double filling = 40e3 * std::pow(loads.pressure / (p.C_a * p.scale), p.exponent / 2.76);
  return (V_0 + filling) / (1.0 + 0.8 * loads.activation * p.T_scale);
}

Plan plan() {
  Plan p;
  p.ed_pressure = 8.0 * mmHg;
  p.es_pressure = 120.0 * mmHg;
  p.tolerance = 0.01;
  p.stiffness = {0.05, 50.0};
  p.exponent = {0.2, 5.0};
  p.T_scale = {0.1, 20.0};
  p.edv.origin = "case.toml:3";
  p.esv.origin = "case.toml:4";
  return p;
}

double unloaded_volume(const FitParameters&) {
  return V_0;
}

const Model model{volume, unloaded_volume, {}};

/// To find C_a and T_scale from the volumes that these make.
Plan plan_for(const FitParameters& truth) {
  Plan p = plan();
  p.passive = FittedPassive::C_a;
  p.active = true;
  p.edv.volume = volume(truth, {p.ed_pressure, 0.0});
  p.esv.volume = volume(truth, {p.es_pressure, 1.0});
  return p;
}

}  // namespace

TEST_CASE("C_a and T_scale that made the volumes are found", "[calibrate]") {
  const FitParameters truth{.C_a = 7.5, .T_scale = 5.5};
  const Plan p = plan_for(truth);
  const Fit found = fit(model, {.C_a = 1.0, .T_scale = 3.0}, p);
  CHECK(found.parameters.C_a == Approx(truth.C_a).epsilon(1e-3));
  CHECK(found.parameters.T_scale == Approx(truth.T_scale).epsilon(1e-3));
  CHECK(found.edv == Approx(p.edv.volume).epsilon(1e-4));
  CHECK(found.esv == Approx(p.esv.volume).epsilon(1e-4));
  CHECK(found.history.front().purpose == "bracket of C_a");
  CHECK(found.history.front().parameters.C_a == 1.0);
}

TEST_CASE("a fit says how it moves with the measurements", "[calibrate]") {
  const FitParameters truth{.C_a = 7.5, .T_scale = 5.5};
  const Plan p = plan_for(truth);
  const Sensitivity s = fit(model, truth, p).sensitivity;

  Plan moved = p;  // by fitting again
  moved.tolerance = 1e-6;
  moved.edv.volume *= 1.001;
  const FitParameters by_edv = fit(model, truth, moved).parameters;
  CHECK(s.by_data(0, 0) == Approx(std::log(by_edv.C_a / truth.C_a) / 1e-3).epsilon(0.01));
  CHECK(s.by_data(1, 0) == Approx(std::log(by_edv.T_scale / truth.T_scale) / 1e-3).epsilon(0.01));

  moved.edv.volume = p.edv.volume;
  moved.ed_pressure *= 1.001;
  const double dp = 1e-3 * p.ed_pressure;
  const FitParameters by_p = fit(model, truth, moved).parameters;
  CHECK(s.by_data(0, 2) == Approx(std::log(by_p.C_a / truth.C_a) / dp).epsilon(0.01));
  CHECK(s.by_data(1, 2) == Approx(std::log(by_p.T_scale / truth.T_scale) / dp).epsilon(0.01));
  CHECK(s.by_data(0, 1) == Approx(0.0).margin(1e-9));  // ESV says nothing about C_a
}

TEST_CASE("scale and exponent are found from the end-diastolic point and the Klotz curve",
          "[calibrate]") {
  Plan p = plan();
  p.passive = FittedPassive::scale_and_exponent;
  p.edv.volume = volume({.scale = 3.0}, {p.ed_pressure, 0.0});
  const Fit found = fit(model, {.scale = 1.0, .exponent = 1.6}, p);
  CHECK(found.parameters.scale == Approx(3.0).epsilon(1e-3));
  CHECK(found.parameters.exponent == Approx(1.0).epsilon(1e-3));
  CHECK(found.sensitivity.parameters.size() == 2);
  CHECK(std::abs(found.sensitivity.correlation(0, 1)) < 1.0);
}

TEST_CASE("a volume out of reach is refused with the nearest within reach", "[calibrate]") {
  Plan p = plan();
  p.passive = FittedPassive::C_a;
  p.edv.volume = 65e3;  // below the unloaded volume
  const double least = 1e-3 * volume({.C_a = 50.0}, {p.ed_pressure, 0.0});
  using Catch::Matchers::Contains;
  CHECK_THROWS_AS(fit(model, {}, p), lv::InputError);
  CHECK_THROWS_WITH(fit(model, {}, p), Contains("case.toml:3: 65.00 ml cannot be reached") &&
                                           Contains(fmt::format("{:.2f} ml at C_a = 50", least)));
}

TEST_CASE(
    "a volume out of reach is told with the parameters that come nearest, from where another "
    "wall finds out at once",
    "[calibrate]") {
  Plan p = plan_for({.C_a = 2.5, .T_scale = 4.0});
  p.esv.volume = 0.98 * volume({.C_a = 2.5, .T_scale = 20.0}, {p.es_pressure, 1.0});
  FitParameters nearest;
  try {
    static_cast<void>(fit(model, {}, p));
    FAIL("it is within reach");
  } catch (const FitOutOfReach& failure) {
    nearest = failure.parameters();
    CHECK(failure.missing() == Approx(-std::log(0.98)).epsilon(1e-2));
  }
  CHECK(nearest.C_a == Approx(2.5).epsilon(1e-3));
  CHECK(nearest.T_scale == Approx(20.0));
  int contracted = 0;
  const Model counted{[&](const FitParameters& q, const Loads& loads) {
                        contracted += loads.activation > 0.0 ? 1 : 0;
                        return volume(q, loads);
                      },
                      unloaded_volume,
                      {}};
  p.starts_near = true;
  CHECK_THROWS_AS(fit(counted, nearest, p), FitOutOfReach);
  CHECK(contracted == 1);
}

TEST_CASE("muscle that does not fill to the end-systolic volume is refused before it contracts",
          "[calibrate]") {
  Plan p = plan();
  p.active = true;
  const double edv = volume({}, {p.ed_pressure, 0.0});
  p.esv.volume = 1.1 * edv;
  int contracted = 0;
  const Model counted{[&](const FitParameters& q, const Loads& loads) {
                        contracted += loads.activation > 0.0 ? 1 : 0;
                        return volume(q, loads);
                      },
                      unloaded_volume,
                      {}};
  CHECK_THROWS_WITH(fit(counted, {}, p),
                    Catch::Matchers::Contains(fmt::format("fills to {:.2f} ml", 1e-3 * edv)) &&
                        Catch::Matchers::Contains("nothing would be ejected"));
  CHECK(contracted == 0);
  p.esv.volume = 0.5 * edv;
  CHECK(fit(counted, {}, p).esv == Approx(p.esv.volume).epsilon(1e-3));
}

TEST_CASE("the bracket keeps away from where the model has no equilibrium", "[calibrate]") {
  Plan p = plan();
  p.passive = FittedPassive::C_a;
  p.edv.volume = volume({.C_a = 0.72}, {p.ed_pressure, 0.0});
  const auto fragile = [](const FitParameters& q, const Loads& loads) -> lv::Outcome<double> {
    if (q.C_a < 0.7)
      return lv::Unsolved{"no equilibrium", ""};
    return volume(q, loads);
  };
  CHECK(fit({fragile, unloaded_volume, {}}, {}, p).parameters.C_a == Approx(0.72).epsilon(1e-3));
}

namespace {

/// Strains of two segments that the two parameters move differently.
std::vector<double> strains(const FitParameters& p, const Loads& ed, const Loads& es) {
  const double filling = std::log(volume(p, ed) / V_0);
  return {-0.1 - 0.05 * std::log(p.T_scale) * es.activation, -0.05 - 0.2 * filling};
}

}  // namespace

TEST_CASE("volumes and strains of a twin give its parameters back", "[calibrate]") {
  const FitParameters truth{.C_a = 2.5, .T_scale = 4.0};
  Plan p = plan_for(truth);
  const std::vector<double> seen = strains(truth, {p.ed_pressure, 0.0}, {p.es_pressure, 1.0});
  p.strains = {{"3 ant", seen[0]}, {"3 inf", seen[1]}};
  p.edv.volume *= 1.03;  // where the brackets lead astray, and the strains back
  const Model with_strains{volume, unloaded_volume, strains};
  p.errors = {.volume = 1.0, .strain = 1e-3};
  const Fit found = fit(with_strains, {.C_a = 1.0, .T_scale = 3.0}, p);
  CHECK(found.parameters.C_a == Approx(truth.C_a).epsilon(1e-3));
  CHECK(found.parameters.T_scale == Approx(truth.T_scale).epsilon(1e-3));
  REQUIRE(found.regional_fit);
  CHECK(found.regional_fit->strain.rms < 1e-5);
  CHECK(found.regional_fit->degrees_of_freedom == Approx(2.0));
}

TEST_CASE("the covariance of a fit to strains is that of its linear model", "[calibrate]") {
  const FitParameters truth{.C_a = 2.5, .T_scale = 4.0};
  Plan p = plan_for(truth);
  const std::vector<double> seen = strains(truth, {p.ed_pressure, 0.0}, {p.es_pressure, 1.0});
  p.strains = {{"3 ant", seen[0]}, {"3 inf", seen[1]}};
  p.errors = {.volume = 0.02, .strain = 0.01};
  const Sensitivity s = fit({volume, unloaded_volume, strains}, truth, p).sensitivity;
  Eigen::MatrixXd J(4, 2);
  J << s.by_parameter / 0.02, s.strain_by_parameter / 0.01;
  const Eigen::MatrixXd C = (J.transpose() * J).inverse();
  CHECK((s.covariance - C).norm() < 1e-6 * C.norm());
  CHECK(s.strain_by_parameter(0, 1) == Approx(-0.05).epsilon(1e-3));
  CHECK(s.strain_by_parameter(0, 0) == Approx(0.0).margin(1e-6));
}

TEST_CASE("factors of segments are drawn to 1 as far as the penalty determines them",
          "[calibrate]") {
  const double slope = -0.05;
  const auto of_segments = [&](const FitParameters& p, const Loads&, const Loads&) {
    return std::vector<double>{-0.1 + slope * std::log(p.T_scale * p.segments[6]),
                               -0.1 + slope * std::log(p.T_scale * p.segments[8])};
  };
  FitParameters truth{.C_a = 2.5, .T_scale = 4.0};
  truth.segments[6] = 0.3;
  Plan p = plan_for(truth);
  const std::vector<double> seen = of_segments(truth, {}, {});
  p.strains = {{"7", seen[0]}, {"9", seen[1]}};
  p.errors = {.volume = 1e-5, .strain = 0.03, .shape = 0.1};  // volumes determine the others
  p.segments = {7, 9};
  p.spread = 0.5;
  p.drawn = {"1 endo ant", "1 endo inf", "2 endo ant"};  // the first two above the base
  const auto distances = [](const FitParameters&, const Loads&) {
    return lv::Outcome<std::vector<double>>(std::vector<double>{0.0, 0.0, 0.3});
  };
  const Fit found =
      fit({volume, unloaded_volume, of_segments, distances}, {.C_a = 1.0, .T_scale = 3.0}, p);
  const double data = std::pow(slope / p.errors.strain, 2);
  const double penalty = 1.0 / (p.spread * p.spread);
  REQUIRE(found.segments.size() == 2);
  CHECK(found.segments[0].segment == 7);
  CHECK(found.segments[0].resolution == Approx(data / (data + penalty)).epsilon(1e-3));
  const RegionalFit& f = found.regional_fit.value();
  CHECK(f.degrees_of_freedom == Approx(3.0 - 2.0 * data / (data + penalty)).epsilon(1e-3));
  const double misfit = f.chi_squared / f.degrees_of_freedom;
  CHECK(misfit > 1.0);
  CHECK(found.segments[0].error ==
        Approx(std::sqrt(1.0 / (data / misfit + penalty))).epsilon(1e-3));
  CHECK(std::log(found.segments[0].factor) ==
        Approx(found.segments[0].resolution * std::log(0.3)).epsilon(1e-2));
  CHECK(found.segments[1].factor == Approx(1.0).epsilon(1e-2));
  CHECK(found.parameters.segments[6] == found.segments[0].factor);
  CHECK(found.parameters.segments[0] == 1.0);
  CHECK(found.parameters.T_scale == Approx(4.0).epsilon(1e-3));
}

TEST_CASE("a fit that the strains pull off its volumes is reported, not refused", "[calibrate]") {
  const FitParameters truth{.C_a = 2.5, .T_scale = 4.0};
  Plan p = plan_for(truth);
  const std::vector<double> seen = strains(truth, {p.ed_pressure, 0.0}, {p.es_pressure, 1.0});
  p.strains = {{"3 ant", seen[0] - 0.05}, {"3 inf", seen[1]}};
  p.errors = {.volume = 0.02, .strain = 0.01};
  const Fit found = fit({volume, unloaded_volume, strains}, truth, p);
  CHECK(std::abs(found.esv / p.esv.volume - 1.0) > p.tolerance);
  CHECK(found.regional_fit->chi_squared > 1.0);
}

TEST_CASE(
    "a fit to a shape weighs distances by their error, and its covariance is that of the "
    "linear model",
    "[calibrate]") {
  const FitParameters truth{.C_a = 2.5, .T_scale = 4.0};
  Plan p = plan_for(truth);
  p.esv.volume *= 1.1;
  p.drawn = {"1 endo ant", "1 endo inf"};
  p.errors = {.volume = 0.02, .shape = 0.5};
  const double es_volume = volume(truth, {p.es_pressure, 1.0});
  const auto distances = [&](const FitParameters& q, const Loads& es) {
    const double larger = std::log(volume(q, es) / es_volume);
    return lv::Outcome<std::vector<double>>(std::vector<double>{20.0 * larger, 10.0 * larger});
  };
  const Fit found = fit({volume, unloaded_volume, {}, distances}, {.T_scale = 3.0}, p);
  // of x = ln(V/V_truth): (x - ln 1.1)/0.02 and 20 x/0.5, 10 x/0.5, near enough
  const double x = std::log(1.1) * 2500.0 / (2500.0 + 1600.0 + 400.0);
  CHECK(std::log(found.esv / es_volume) == Approx(x).epsilon(0.1));
  REQUIRE(found.regional_fit);
  CHECK(found.regional_fit->degrees_of_freedom == Approx(2.0));
  const ShapeFit& shape = found.regional_fit->shape.value();
  CHECK(shape.before.rms == Approx(std::sqrt(250.0) * std::log(1.1)).epsilon(1e-3));
  CHECK(shape.after.bias == Approx(15.0 * std::log(found.esv / es_volume)));
  const Sensitivity& s = found.sensitivity;
  Eigen::MatrixXd J(4, 2);
  J << s.by_parameter / 0.02, s.distance_by_parameter / 0.5;
  const Eigen::MatrixXd C = (J.transpose() * J).inverse();
  CHECK((s.covariance - C).norm() < 1e-6 * C.norm());
  CHECK(s.distance_by_parameter(0, 1) == Approx(2.0 * s.distance_by_parameter(1, 1)));
}

TEST_CASE("of a volume with a maximum the stiffer root is found, and the maximum named",
          "[calibrate]") {
  const auto with_maximum = [](const FitParameters& p, const Loads&) {
    return 100e3 - 20e3 * std::pow(std::log(p.scale / 0.5), 2);  // at scale 0.5
  };
  const Model hill{with_maximum, unloaded_volume, {}};
  Plan p = plan();
  p.passive = FittedPassive::scale;
  p.edv.volume = 95e3;
  const double root = 0.5 * std::exp(0.5);
  for (const double start : {0.1, 0.4, 0.55, 1.0, 3.0})
    CHECK(fit(hill, {.scale = start}, p).parameters.scale == Approx(root).epsilon(1e-3));
  p.edv.volume = 101e3;
  for (const double start : {0.1, 0.55, 3.0})
    CHECK_THROWS_WITH(
        fit(hill, {.scale = start}, p),
        Catch::Matchers::Contains("101.00 ml cannot be reached: the model's volume is "
                                  "largest near scale"));
}

TEST_CASE("what is no lack of an equilibrium ends a fit", "[calibrate]") {
  Plan p = plan_for({.C_a = 2.5, .T_scale = 4.0});
  p.passive = FittedPassive::scale_and_exponent;
  int calls = 0;
  const auto disk_full_after = [&](int count) {
    return [&, count](const FitParameters& q, const Loads& loads) {
      if (++calls > count)
        throw lv::RunError("the disk is full", "");
      return volume(q, loads);
    };
  };
  static_cast<void>(fit({disk_full_after(1'000'000), unloaded_volume, {}}, {}, p));
  const int all = std::exchange(calls, 0);
  for (int count = 0; count < all; ++count, calls = 0)
    CHECK_THROWS_WITH(fit({disk_full_after(count), unloaded_volume, {}}, {}, p),
                      Catch::Matchers::Contains("the disk is full"));
}

namespace {

constexpr double V_seen = 144e3;

/// A wall seen under 8 mmHg whose unloaded volume and filling curve are Klotz's for scale 3 and
/// exponent 1.2; below a stiffness it has no shape without load.
Model seen_wall(double softest) {
  const auto unloaded = [=](const FitParameters& p) -> lv::Outcome<double> {
    if (p.scale < softest)
      return lv::Unsolved{"the wall folds", ""};
    const double taken_up = V_seen - klotz(V_seen, 8.0 * mmHg).V0;
    return V_seen - taken_up * std::pow(3.0 / p.scale, 0.5) * std::pow(1.2 / p.exponent, 0.2);
  };
  const auto loaded = [=](const FitParameters& p, const Loads& loads) -> lv::Outcome<double> {
    auto V = unloaded(p);
    if (!V)
      return V;
    const double share = std::pow(loads.pressure / (8.0 * mmHg), p.exponent / 1.2 / 2.76);
    return (*V + (V_seen - *V) * share) / (1.0 + 0.8 * loads.activation * p.T_scale);
  };
  return {loaded, unloaded, {}};
}

Plan klotz_plan() {
  Plan p = plan();
  p.passive = FittedPassive::klotz;
  p.edv.volume = V_seen;
  return p;
}

}  // namespace

TEST_CASE("scale and exponent of an end-diastolic shape are found from the Klotz curve alone",
          "[calibrate]") {
  for (const double softest : {0.01, 2.5}) {
    const Plan p = klotz_plan();
    const Fit found = fit(seen_wall(softest), {}, p);
    CHECK(found.parameters.scale == Approx(3.0).epsilon(0.01));
    CHECK(found.parameters.exponent == Approx(1.2).epsilon(0.01));
    CHECK(found.unloaded_volume == Approx(klotz(V_seen, p.ed_pressure).V0).epsilon(1e-3));
    CHECK(found.edv == Approx(V_seen));
    CHECK(found.history.size() < 60);
  }
}

TEST_CASE("contractility is fitted beside the Klotz curve", "[calibrate]") {
  Plan p = klotz_plan();
  p.active = true;
  const Model wall = seen_wall(0.01);
  p.esv.volume =
      *wall.volume({.scale = 3.0, .exponent = 1.2, .T_scale = 2.5}, {p.es_pressure, 1.0});
  const Fit found = fit(wall, {}, p);
  CHECK(found.parameters.T_scale == Approx(2.5).epsilon(0.02));
  CHECK(found.esv == Approx(p.esv.volume).epsilon(p.tolerance));
}

TEST_CASE("an end-systolic volume out of reach is refused before the curve is fitted",
          "[calibrate]") {
  using Catch::Matchers::Contains;
  Plan p = klotz_plan();
  p.active = true;
  p.T_scale = {0.1, 4.0};
  const Model wall = seen_wall(0.01);
  int partly_filled = 0;
  const Model counted{[&](const FitParameters& q, const Loads& loads) {
                        partly_filled += loads.activation == 0.0 && loads.pressure > 0.0 ? 1 : 0;
                        return wall.volume(q, loads);
                      },
                      wall.unloaded_volume,
                      {}};
  p.esv.volume = 20e3;
  CHECK_THROWS_WITH(fit(counted, {}, p), Contains("case.toml:4: 20.00 ml cannot be reached") &&
                                             Contains("at T_scale = 4, the end of its range") &&
                                             Contains("first try"));
  CHECK(partly_filled == 0);
  // what is missed by less may yet be reached
  const double least =
      *wall.volume({.scale = 3.0, .exponent = 1.2, .T_scale = 4.0}, {p.es_pressure, 1.0});
  p.esv.volume = 1.001 * least;
  CHECK(fit(wall, {}, p).parameters.T_scale == Approx(4.0).epsilon(0.01));
}

TEST_CASE("a fit that starts near its end goes on from there, or begins anew", "[calibrate]") {
  Plan p = klotz_plan();
  p.starts_near = true;
  const Fit near = fit(seen_wall(0.01), {.scale = 2.9, .exponent = 1.25}, p);
  CHECK(near.parameters.scale == Approx(3.0).epsilon(0.01));
  CHECK(near.history.size() < fit(seen_wall(0.01), {}, klotz_plan()).history.size());
  const Fit anew = fit(seen_wall(2.5), {.scale = 2.0, .exponent = 1.25}, p);
  CHECK(anew.parameters.scale == Approx(3.0).epsilon(0.01));
}

TEST_CASE("a V0 below what any wall without load holds is refused with what there is",
          "[calibrate]") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_AS(fit(seen_wall(4.0), {}, klotz_plan()), lv::InputError);
  CHECK_THROWS_WITH(fit(seen_wall(4.0), {}, klotz_plan()),
                    Contains("cannot hold 79.49 ml without load") &&
                        Contains("the softest for which there is a shape without load") &&
                        Contains("the wall folds"));
  CHECK_THROWS_WITH(fit(seen_wall(100.0), {}, klotz_plan()),
                    Contains("no stiffness up to scale = 16"));
  Plan stiff = klotz_plan();
  stiff.stiffness = {5.0, 50.0};
  CHECK_THROWS_WITH(fit(seen_wall(0.01), {}, stiff), Contains("the end of its range"));
}

TEST_CASE("a wall that folds and holds more than V0 ends the search for softer ones",
          "[calibrate]") {
  using Catch::Matchers::Contains;
  Model wall = seen_wall(100.0);
  wall.folded_volume = [] { return 90e3; };
  CHECK_THROWS_WITH(fit(wall, {}, klotz_plan()),
                    Contains("no stiffness up to scale = 2 ") && Contains("hold more already"));
  wall.folded_volume = [] { return 70e3; };
  CHECK_THROWS_WITH(fit(wall, {}, klotz_plan()),
                    Contains("no stiffness up to scale = 16") && !Contains("more already"));
}

TEST_CASE("a fit to the Klotz curve begins where the wall along the pressure holds V0",
          "[calibrate]") {
  using Catch::Matchers::Contains;
  Model wall = seen_wall(100.0);
  wall.share_that_leaves = [](const FitParameters& p, double volume) -> lv::Outcome<double> {
    CHECK(volume == Approx(klotz(V_seen, 8.0 * mmHg).V0));
    return p.scale / 11.0;
  };
  wall.folded_volume = [] { return 90e3; };
  CHECK_THROWS_WITH(fit(wall, {}, klotz_plan()), Contains("no stiffness up to scale = 11 "));
}

TEST_CASE("by how much a V0 is missed is known where the range of the stiffness ends it",
          "[calibrate]") {
  const auto missing = [](const Model& wall, const Plan& p) {
    try {
      static_cast<void>(fit(wall, {}, p));
    } catch (const OutOfReach& failure) {
      return failure.missing();
    }
    return -1.0;
  };
  Plan stiff = klotz_plan();
  stiff.stiffness = {5.0, 50.0};
  const Model wall = seen_wall(0.01);
  const double V0 = klotz(V_seen, stiff.ed_pressure).V0;
  CHECK(missing(wall, stiff) == Approx(std::log(*wall.unloaded_volume({.scale = 5.0}) / V0)));
  CHECK(missing(seen_wall(4.0), klotz_plan()) == 0.0);  // another mesh may have softer walls
  CHECK(missing(seen_wall(100.0), klotz_plan()) == 0.0);
}
