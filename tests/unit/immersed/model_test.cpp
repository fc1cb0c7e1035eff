#include "lv/immersed/model.hpp"

#include "lv/implicit/equations.hpp"
#include "lv/verify/small_ventricle.hpp"

#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <numeric>

namespace {

using namespace lv;
using immersed::Model;
using immersed::ModelState;

constexpr std::array<int, 3> cells{20, 20, 27};

mesh::Mesh coarse_mesh() {
  return verify::ideal_mesh({.edge_length = 9.0});
}

/// A wall that nothing holds but what it is given.
solid::CardiacModel held_by(const solid::Surroundings& surroundings) {
  return {.base = {.kind = solid::BasalSupport::Kind::elastic}, .surroundings = surroundings};
}

solid::Surroundings springs_and_dashpots() {
  solid::Surroundings s;
  s.epicardium = {3.0, 0.2, 0.05, 0.01, {solid::AxialWeight::WeightShape::sigmoid, 0.5}};
  s.base = {20.0, 5.0, 0.02, 0.005, {}};
  return s;
}

/// A displaced wall on the move.
ModelState moved(Model& model) {
  ModelState state = model.state();
  test::RandomValues random(3);
  for (std::size_t a = 0; a < state.positions.size(); ++a) {
    state.positions[a] += 0.3 * random.vector();
    state.node_velocities[a] = 20.0 * random.vector();
  }
  return state;
}

std::vector<Vec3> forces(const mesh::Mesh& mesh, const solid::Surroundings& surroundings) {
  Model model(mesh, held_by(surroundings), verify::in_default_box(mesh, cells));
  model.restore(moved(model));
  static_cast<void>(model.step({}, 1e-5));
  return {model.node_forces().begin(), model.node_forces().end()};
}

/// The residual of the implicit engine's equations at the same place and velocity.
std::vector<double> residual(const mesh::Mesh& mesh, const solid::Surroundings& surroundings,
                             const ModelState& at) {
  const implicit::Equations equations(mesh, held_by(surroundings));
  implicit::State state = equations.rest();
  state.positions = at.positions;
  const implicit::Motion motion{at.positions, at.node_velocities, {}, 0.0, 0.0};
  const implicit::TensionAt none = [](std::size_t, std::size_t, double) {
    return implicit::Tension{};
  };
  return equations.residual(state, 0.0, none, &motion);
}

/// Muscle with some tension under pressure, a few steps after rest.
Model under_way(const mesh::Mesh& mesh) {
  Model model(mesh, {}, verify::in_default_box(mesh, cells));
  model.relax(0.3);
  for (int n = 0; n < 20; ++n)
    static_cast<void>(model.step({0.02 * n, 0.0, 0.3}, 2e-4));
  return model;
}

/// What the endocardium sweeps on a straight way [mm^3].
double swept(const mesh::Mesh& mesh, const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  std::vector<Vec3> middle(from.size());
  for (std::size_t a = 0; a < from.size(); ++a)
    middle[a] = 0.5 * (from[a] + to[a]);
  std::vector<Vec3> gradient(from.size(), Vec3::Zero());
  solid::EndocardialSurface(mesh).add_gradient(1.0, middle, gradient);
  double sum = 0.0;
  for (std::size_t a = 0; a < from.size(); ++a)
    sum += gradient[a].dot(to[a] - from[a]);
  return sum;
}

/// int n da over the endocardium [mm^2].
Vec3 opening_area(const mesh::Mesh& mesh, const std::vector<Vec3>& positions) {
  std::vector<Vec3> gradient(positions.size(), Vec3::Zero());
  solid::EndocardialSurface(mesh).add_gradient(1.0, positions, gradient);
  return -std::reduce(gradient.begin(), gradient.end(), Vec3(Vec3::Zero()));
}

}  // namespace

TEST_CASE("supports hold the immersed wall as they hold the implicit one", "[unit][immersed]") {
  const mesh::Mesh mesh = coarse_mesh();
  const std::vector<Vec3> held = forces(mesh, springs_and_dashpots());
  const std::vector<Vec3> free = forces(mesh, {});
  Model like(mesh, held_by({}), verify::in_default_box(mesh, cells));
  const ModelState at = moved(like);
  const auto R_held = residual(mesh, springs_and_dashpots(), at);
  const auto R_free = residual(mesh, {}, at);
  REQUIRE(R_held.size() == R_free.size());
  REQUIRE(!R_held.empty());
  double largest = 0.0;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    for (int i = 0; i < 3; ++i) {
      const double support = held[a][i] - free[a][i];
      largest = std::max(largest, std::abs(support));
      // differences of elastic forces of up to 1e4 mN
      CHECK(support == Approx(-(R_held[3 * a + i] - R_free[3 * a + i])).margin(1e-8));
    }
  CHECK(largest > 10.0);  // [mN]
}

TEST_CASE("supports limit the step of the immersed engine", "[unit][immersed]") {
  const mesh::Mesh mesh = coarse_mesh();
  const auto parameters = verify::in_default_box(mesh, cells);
  CHECK(std::isinf(Model(mesh, {}, parameters).longest_step()));
  const double mass = 1e-6 * parameters.grid.spacing.minCoeff();
  const Model held(mesh, held_by(springs_and_dashpots()), parameters);
  CHECK(held.longest_step() == springs_and_dashpots().longest_step(mass));
}

TEST_CASE("a step finds the pressure by which the endocardium sweeps a volume",
          "[unit][immersed]") {
  const mesh::Mesh mesh = coarse_mesh();
  Model model = under_way(mesh);
  const std::vector<Vec3> before = model.state().positions;
  constexpr double wanted = 3.0;  // [mm^3]
  const double volume = model.cavity_volume() + wanted;
  immersed::StepVolume seen;
  const auto report = model.step(
      {0.4, 0.0, 0.3}, 2e-4,
      [&](const immersed::StepVolume& v) {
        seen = v;
        return v.guess + (volume - v.volume) / v.per_pressure;
      },
      true);
  CHECK(seen.guess == 0.4);
  CHECK(seen.per_pressure > 0.0);
  CHECK(std::abs(report.pressure - 0.4) > 0.01);
  // the middle of the step is predicted with the velocity before it
  CHECK(swept(mesh, before, model.state().positions) == Approx(wanted).epsilon(1e-3));

  Model given = under_way(mesh);
  static_cast<void>(given.step({report.pressure, 0.0, 0.3}, 2e-4));
  const auto& x = model.state().positions;
  const auto& y = given.state().positions;
  for (std::size_t a = 0; a < x.size(); ++a)
    CHECK((x[a] - y[a]).norm() < 1e-11);
}

TEST_CASE("a closed valve is held over many steps with an old response", "[unit][immersed]") {
  const mesh::Mesh mesh = coarse_mesh();
  Model model(mesh, {}, verify::in_default_box(mesh, cells));
  model.relax(0.01);
  double pressure = 0.0;
  double largest_jump = 0.0;
  for (int n = 0; n < 200; ++n) {
    const std::vector<Vec3> before = model.state().positions;
    const auto report = model.step(
        {pressure, 0.0, 0.01 + 0.005 * n}, 2e-4,
        [&](const immersed::StepVolume& v) {
          return v.guess - (v.volume - model.cavity_volume()) / v.per_pressure;
        },
        n % 10 == 0);
    largest_jump = std::max(largest_jump, std::abs(report.pressure - pressure));
    pressure = report.pressure;
    CHECK(std::abs(swept(mesh, before, model.state().positions)) < 1e-3);  // [mm^3]
  }
  CHECK(pressure > 1.0);      // it contracts against the closed valve
  CHECK(largest_jump < 0.5);  // [kPa]
}

TEST_CASE("a lid that the base carries follows the pressure less than the endocardium's edge does",
          "[unit][immersed]") {
  const mesh::Mesh mesh = coarse_mesh();
  const auto velocities = [&](double pressure) {
    Model model(mesh, held_by({.base = {5.0, 5.0, 0.0, 0.0, {}}}),
                verify::in_default_box(mesh, cells));
    for (int n = 0; n < 2; ++n)
      static_cast<void>(model.step({pressure, 0.0, 0.0}, 2e-4));
    return model.state().node_velocities;
  };
  std::vector<Vec3> response = velocities(1.0);
  const std::vector<Vec3> without = velocities(0.0);
  for (std::size_t a = 0; a < response.size(); ++a)
    response[a] -= without[a];
  std::vector<Vec3> swept(response.size(), Vec3::Zero());
  std::vector<Vec3> closed(response.size(), Vec3::Zero());
  solid::EndocardialSurface(mesh).add_gradient(1.0, mesh.nodes, swept);
  solid::EndocardialSurface(mesh).add_volume_gradient(mesh.nodes, closed);
  const auto sum = [&](const std::vector<Vec3>& gradient) {
    return std::transform_reduce(gradient.begin(), gradient.end(), response.begin(), 0.0,
                                 std::plus<>(),
                                 [](const Vec3& g, const Vec3& v) { return g.dot(v); });
  };
  const Vec3 opening = -std::reduce(swept.begin(), swept.end(), Vec3(Vec3::Zero()));
  const double of_lid = opening.dot(solid::Opening(mesh).carried(response));
  const double of_edge = sum(closed) - sum(swept);
  CHECK(sum(swept) > 0.0);
  CHECK(of_edge < 0.0);
  CHECK(std::abs(of_lid) < 0.3 * std::abs(of_edge));
}

TEST_CASE("a closed valve goes along with an elastic base", "[unit][immersed]") {
  const mesh::Mesh mesh = coarse_mesh();
  Model model(mesh, held_by({.base = {5.0, 5.0, 0.005, 0.005, {}}}),
              verify::in_default_box(mesh, cells));
  model.relax(0.01);
  const solid::Opening opening(mesh);
  double pressure = 0.0;
  double by_endocardium = 0.0;
  double largest_jump = 0.0;
  for (int n = 0; n < 400; ++n) {
    const std::vector<Vec3> before = model.state().positions;
    const auto report = model.step(
        {pressure, 0.0, 0.01 + 0.0025 * n}, 2e-4,
        [&](const immersed::StepVolume& v) {
          return v.guess - (v.volume - model.cavity_volume()) / v.per_pressure;
        },
        n % 10 == 0);
    largest_jump = std::max(largest_jump, std::abs(report.pressure - pressure));
    pressure = report.pressure;
    const std::vector<Vec3>& after = model.state().positions;
    const double dV = swept(mesh, before, after);
    const Vec3 lid = opening.carried(after) - opening.carried(before);
    CHECK(std::abs(dV + opening_area(mesh, before).dot(lid)) < 1e-3);  // [mm^3]
    by_endocardium += dV;
  }
  CHECK(pressure > 1.0);       // it contracts against the closed valve
  CHECK(largest_jump < 0.05);  // [kPa]
  // the base gives way, towards the apex, and the endocardium with it
  CHECK(opening.carried(model.positions()).z() < -0.2);
  CHECK(by_endocardium > 200.0);
}

TEST_CASE("a lid on a rigid base goes where the base is held", "[unit][immersed]") {
  const mesh::Mesh mesh = coarse_mesh();
  Model model(mesh, {}, verify::in_default_box(mesh, cells));
  const auto volume_at_guess = [&](const Vec3& velocity) {
    model.hold_base({{}, {Mat3::Zero(), velocity}});
    double volume = 0.0;
    static_cast<void>(model.step(
        {}, 2e-4,
        [&](const immersed::StepVolume& v) {
          volume = v.volume;
          return v.guess;
        },
        true));
    return volume - model.cavity_volume();
  };
  const double still = volume_at_guess(Vec3::Zero());
  // 2e-4 s at 100 mm/s towards the apex, over an opening of some 1000 mm^2
  const double moving = volume_at_guess({0.0, 0.0, -100.0});
  CHECK(moving - still == Approx(-0.02 * opening_area(mesh, mesh.nodes).z()).epsilon(0.01));
}

TEST_CASE("that muscle is slack is part of the state", "[unit][immersed]") {
  const mesh::Mesh mesh = coarse_mesh();
  Model model(mesh, {}, verify::in_default_box(mesh, cells));
  model.relax(1.0);
  model.slacken();
  static_cast<void>(model.step({0.0, 0.0, 1.0}, 2e-4));
  const immersed::ModelState slack = model.state();
  model.balance(1.0);
  CHECK(model.mean_tension() > 1.0);
  model.restore(slack);
  static_cast<void>(model.step({0.0, 0.0, 1.0}, 2e-4));
  CHECK(model.mean_tension() == 0.0);
}

TEST_CASE("slack muscle has no tension until it is balanced at its stretch", "[unit][immersed]") {
  const mesh::Mesh mesh = coarse_mesh();
  solid::CardiacModel heart;
  heart.myocardium.active = material::Land2017{};
  Model model(mesh, heart, verify::in_default_box(mesh, cells));
  model.slacken();
  for (int n = 0; n < 50; ++n)
    static_cast<void>(model.step({0.02 * n, 0.0, 0.3}, 2e-4));
  CHECK(model.mean_tension() == 0.0);
  model.balance(0.3);
  std::vector<double> stretch(mesh.nodes.size());
  model.wall().nodal_stretch(model.positions(), stretch);
  const auto tension = model.contraction().tension();
  for (std::size_t a = 0; a < stretch.size(); ++a)
    CHECK(tension[a] == Approx(material::Land2017{}.steady_state(0.3, stretch[a]).tension));
}

TEST_CASE("the immersed wall has the factors of its segments", "[unit][immersed]") {
  mesh::Mesh mesh = coarse_mesh();
  mesh.segment = mesh::divide(mesh, {}).aha;
  solid::CardiacModel half;
  half.contractility.fill(0.5);
  Model model(mesh, half, verify::in_default_box(mesh, cells));
  model.relax(0.5);
  Model whole(mesh, {}, verify::in_default_box(mesh, cells));
  whole.relax(0.5);
  CHECK(model.mean_tension() == Approx(0.5 * whole.mean_tension()));
  CHECK(whole.mean_tension() > 1.0);
}
