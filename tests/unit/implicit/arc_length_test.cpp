#include "lv/implicit/arc_length.hpp"

#include "lv/base/units.hpp"
#include "lv/implicit/engine.hpp"
#include "lv/verify/half_sphere.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

namespace {

using namespace lv;
using implicit::Equations;
using implicit::PathStep;
using implicit::State;
using solid::Loads;

/// A rubber balloon, of which a half stands on its equator. Its pressure has a maximum, beyond
/// which it grows while the pressure falls.
struct Balloon {
  verify::HalfSphere shell{.A = 10.0, .B = 10.5, .mu = 10.0};
  mesh::Mesh mesh = shell.mesh(6.0, 2);
  Equations equations{mesh, rubber(shell.mu)};

  static solid::CardiacModel rubber(double mu) {
    solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
    heart.myocardium.passive = material::NeoHookean{mu};
    heart.myocardium.active = material::PrescribedTension{0.0};
    return heart;
  }

  /// In equilibrium with an inner radius [mm] [kPa].
  [[nodiscard]] double pressure(double a) const {
    return verify::HalfSphere{shell.A, shell.B, a, shell.mu}.pressure();
  }

  /// The inner radius in which the cavity has a volume [mm^3].
  [[nodiscard]] double radius(double volume) const {
    return shell.A * std::cbrt(volume / equations.endocardium().volume(mesh.nodes));
  }

  /// The largest pressure, and the inner radius there.
  [[nodiscard]] std::pair<double, double> largest() const {
    std::pair<double, double> most{0.0, 0.0};
    for (double a = shell.A; a < 2.0 * shell.A; a += 1e-4 * shell.A)
      most = std::max(most, {pressure(a), a});
    return most;
  }
};

}  // namespace

TEST_CASE("the path of a balloon passes its largest pressure and goes on where the pressure falls",
          "[unit][implicit]") {
  const Balloon balloon;
  const auto [largest, radius] = balloon.largest();
  // a thin shell's pressure is proportional to 1/lambda - 1/lambda^7
  CHECK(radius / balloon.shell.A == Approx(std::pow(7.0, 1.0 / 6.0)).epsilon(0.02));

  State state = balloon.equations.rest();
  const implicit::WayOfLoads way{{}, {1.2 * largest, 0.0}};
  std::vector<PathStep> steps;
  const implicit::Path path =
      follow_path(balloon.equations, state, 0.0, way, {.first = 0.2, .most_steps = 25},
                  [&](const PathStep& step, const State&) { steps.push_back(step); });

  CHECK_FALSE(path.arrived);
  CHECK_THAT(path.why, Catch::Matchers::Contains("25 steps were not enough"));
  REQUIRE(path.turns.size() == 1);
  CHECK(path.turns.front().is_highest);
  CHECK(1.2 * path.turns.front().share == Approx(1.0).epsilon(0.005));
  CHECK(path.turns.front().width > 0.3);  // all of it grows
  double farthest = 0.0;
  for (const PathStep& step : steps) {
    const double a = balloon.radius(step.volume);
    INFO("inner radius " << a << " mm");
    CHECK(step.share * way.to.pressure == Approx(balloon.pressure(a)).epsilon(0.01));
    farthest = std::max(farthest, a);
  }
  CHECK(farthest > 1.2 * radius);
  CHECK(path.share == steps.back().share);
  const double left =
      balloon.pressure(balloon.radius(balloon.equations.endocardium().volume(state.positions)));
  CHECK(path.share * way.to.pressure == Approx(left).epsilon(0.01));
}

TEST_CASE("the path ends where all of the loads are applied", "[unit][implicit]") {
  const Balloon balloon;
  const double pressure = 0.6 * balloon.largest().first;
  implicit::Newton newton(balloon.equations, {});
  State half = balloon.equations.rest();
  REQUIRE(newton.solve(half, Loads{0.5 * pressure, 0.0}).converged);
  State expected = half;
  REQUIRE(newton.solve(expected, Loads{pressure, 0.0}).converged);

  const implicit::Path path = follow_path(balloon.equations, half, 0.5, {{}, {pressure, 0.0}});
  CHECK(path.arrived);
  CHECK(path.why.empty());
  CHECK(path.share == 1.0);
  CHECK(path.turns.empty());
  double off = 0.0;
  for (std::size_t i = 0; i < expected.positions.size(); ++i)
    off = std::max(off, (half.positions[i] - expected.positions[i]).norm());
  CHECK(off < 1e-4);
}

namespace {

/// Rubber that stiffens, I1 - 3 with an exponent: its pressure falls beyond a maximum and rises
/// again.
solid::CardiacModel stiffening() {
  solid::CardiacModel heart = Balloon::rubber(0.0);
  material::HolzapfelOgden law{.a = 10.0, .b = 0.04};
  law.a_f = law.a_s = law.a_fs = 1e-6;
  heart.myocardium.passive = law;
  return heart;
}

}  // namespace

TEST_CASE("contracting muscle goes round along its path to loads that no step leads to",
          "[unit][implicit]") {
  const Balloon balloon;
  implicit::Engine engine(balloon.mesh, stiffening(), {});
  double reached = 0.0;
  const Loads loads{1.1 * balloon.largest().first, 1.0};
  const auto volume = engine.go_to(loads, [&](const implicit::Step& step) {
    CHECK(step.progress > reached);
    reached = step.progress;
  });
  REQUIRE(volume);
  CHECK(reached == Approx(1.0));
  CHECK(engine.loads().pressure == loads.pressure);
  CHECK(balloon.radius(*volume) > balloon.largest().second);  // beyond the maximum
  double imbalance = 0.0;
  for (const double R : engine.equations().residual(engine.state(), loads))
    imbalance = std::max(imbalance, std::abs(R));
  CHECK(imbalance < 1e-3);
}

TEST_CASE("where no path leads to the loads the engine says at which of them it turns, and stays",
          "[unit][implicit]") {
  const Balloon balloon;
  implicit::Engine engine(balloon.mesh, Balloon::rubber(balloon.shell.mu), {});
  const double largest = balloon.largest().first;
  const auto volume = engine.go_to({1.1 * largest, 1.0});
  REQUIRE_FALSE(volume);
  CHECK_THAT(volume.why().what,
             Catch::Matchers::Contains(fmt::format("turns at {:.1f}", largest / units::mmHg)));
  CHECK(engine.loads().pressure == Approx(largest).epsilon(0.005));
  CHECK(balloon.radius(engine.cavity_volume()) < 1.01 * balloon.largest().second);
}
