#include "lv/solid/contraction.hpp"

#include "lv/base/check.hpp"

#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using material::Land2017;
using material::NiedererHunterSmith;
using solid::Contraction;

constexpr std::size_t count = 3 * pack_size + 1;  // the last pack is not full
constexpr double density = 1e-6;

/// Muscle at nodes in a row, 2 mm apart.
Contraction row_of_nodes(const material::ActiveLaw& law = NiedererHunterSmith{}) {
  std::vector<Vec3> nodes;
  for (std::size_t i = 0; i < count; ++i)
    nodes.emplace_back(2.0 * static_cast<double>(i), 0.0, 0.0);
  const std::vector<double> volumes(count, 8.0);
  const std::vector<double> strength(count, 1.0);
  return {law, {nodes, volumes, strength}, density, 1.5};
}

std::vector<double> uneven_stretch(double time) {
  std::vector<double> stretch(count);
  for (std::size_t i = 0; i < count; ++i)
    stretch[i] = 1.05 + 0.05 * std::sin(0.3 * static_cast<double>(i) + 20.0 * time);
  return stretch;
}

void contract(Contraction& muscle, int first, int steps) {
  constexpr double dt = 1e-4;
  for (int i = first; i < first + steps; ++i)
    muscle.advance(uneven_stretch(i * dt), 0.8, 0.8, dt);
}

std::vector<double> tension_of(const Contraction& muscle) {
  return {muscle.tension().begin(), muscle.tension().end()};
}

}  // namespace

TEMPLATE_TEST_CASE("relaxed muscle has the steady tension of its calcium at every node",
                   "[unit][solid]", NiedererHunterSmith, Land2017) {
  Contraction muscle = row_of_nodes(TestType{});
  muscle.relax(0.3);
  const double steady = TestType{}.steady_state(0.3, 1.0).tension;
  REQUIRE(muscle.tension().size() == count);
  for (const double T : muscle.tension())
    CHECK(T == Approx(steady).epsilon(1e-12));
}

TEST_CASE("the factor of a segment's tension is one of the law's strength", "[unit][solid]") {
  std::vector<Vec3> nodes;
  for (std::size_t i = 0; i < count; ++i)
    nodes.emplace_back(2.0 * static_cast<double>(i), 0.0, 0.0);
  const std::vector<double> volumes(count, 8.0);
  const std::vector<double> strength(count, 1.0);
  const std::vector<double> half(count, 0.5);
  NiedererHunterSmith weak;
  weak.T_scale *= 0.5;
  Contraction by_law = row_of_nodes(weak);
  Contraction by_factor(NiedererHunterSmith{}, {nodes, volumes, strength, half}, density, 1.5);
  for (Contraction* muscle : {&by_law, &by_factor}) {
    muscle->relax(0.1);
    contract(*muscle, 0, 30);
  }
  CHECK(by_factor.wave_speed() == Approx(by_law.wave_speed()).epsilon(1e-10));
  for (std::size_t i = 0; i < count; ++i)
    CHECK(by_factor.tension()[i] == Approx(by_law.tension()[i]).epsilon(1e-10));
  by_factor.prescribe(60.0);
  CHECK(by_factor.tension()[1] == 30.0);
}

TEMPLATE_TEST_CASE("relaxed muscle has at every node the steady tension of its own stretch",
                   "[unit][solid]", NiedererHunterSmith, Land2017) {
  Contraction muscle = row_of_nodes(TestType{});
  const std::vector<double> stretch = uneven_stretch(0.03);
  muscle.relax(0.5, stretch);
  for (std::size_t a = 0; a < count; ++a)
    CHECK(muscle.tension()[a] ==
          Approx(TestType{}.steady_state(0.5, stretch[a]).tension).epsilon(1e-12));
}

TEST_CASE("steady muscle stays steady: smoothing and damping see nothing", "[unit][solid]") {
  Contraction muscle = row_of_nodes();
  muscle.relax(1.0);
  const auto before = tension_of(muscle);
  for (int i = 0; i < 100; ++i)
    muscle.advance(std::vector<double>(count, 1.0), 1.0, 1.0, 1e-4);
  for (std::size_t a = 0; a < count; ++a)
    CHECK(muscle.tension()[a] == Approx(before[a]).epsilon(1e-11));
}

TEMPLATE_TEST_CASE("muscle that is stretched the same everywhere contracts like one cell",
                   "[unit][solid]", NiedererHunterSmith, Land2017) {
  const TestType law;
  Contraction muscle = row_of_nodes(law);
  muscle.relax(0.01);
  typename TestType::template State<double> cell = law.steady_state(0.01, 1.0);
  for (int i = 1; i <= 300; ++i) {
    const double stretch = 1.0 + 0.1 * std::sin(0.02 * i);
    muscle.advance(std::vector<double>(count, stretch), 0.9, 0.9, 1e-4);
    law.advance(cell, stretch, 0.9, 0.9, 1e-4);
  }
  for (const double T : muscle.tension())
    // what the filter and the damping do to equal rates is rounding, times 25 MPa
    CHECK(T == Approx(cell.tension).epsilon(1e-9));
}

TEMPLATE_TEST_CASE("muscle restored from its state goes on bit for bit", "[unit][solid]",
                   NiedererHunterSmith, Land2017) {
  Contraction muscle = row_of_nodes(TestType{});
  muscle.relax(0.01);
  contract(muscle, 1, 200);
  const auto state = muscle.state();
  contract(muscle, 201, 50);

  Contraction restored = row_of_nodes(TestType{});
  restored.set_state(state);
  CHECK(restored.state() == state);
  contract(restored, 201, 50);
  CHECK(tension_of(restored) == tension_of(muscle));
  CHECK(restored.state() == muscle.state());
  CHECK(restored.wave_speed() == muscle.wave_speed());
}

TEST_CASE("a state of another wall is our own mistake", "[unit][solid]") {
  CHECK_THROWS_AS(row_of_nodes().set_state(std::vector<double>(7 * count)), LogicError);
}

TEST_CASE("the wave speed is that of the strongest node", "[unit][solid]") {
  Contraction muscle = row_of_nodes();
  muscle.relax(1.0);
  const double T_0 = NiedererHunterSmith{}.steady_state(1.0, 1.0).tension;
  CHECK(muscle.wave_speed() == Approx(std::sqrt(1.35 * 238.0 * T_0 / density)).epsilon(1e-10));
}

TEST_CASE("muscle without kinetics has the tension that is prescribed, and no states",
          "[unit][solid]") {
  Contraction muscle = row_of_nodes(material::PrescribedTension{60.0});
  muscle.relax(1.0);
  CHECK(tension_of(muscle) == std::vector<double>(count, 0.0));
  muscle.prescribe(20.0);
  CHECK(tension_of(muscle) == std::vector<double>(count, 20.0));
  CHECK(muscle.wave_speed() == 0.0);
  CHECK(muscle.state().size() == 1);  // the filter's width
}
