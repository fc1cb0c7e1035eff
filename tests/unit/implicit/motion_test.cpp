#include "lv/implicit/motion.hpp"

#include "lv/base/check.hpp"
#include "lv/implicit/time_engine.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/verify/half_sphere.hpp"

#include "support/block_mesh.hpp"
#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using implicit::Equations;
using implicit::GeneralisedAlpha;
using implicit::Motion;
using implicit::Rates;
using implicit::State;
using mesh::CellKind;

/// The error at time 1 of x'' + 2 d x' + w^2 x = 0 from x = 1, x' = 0, by steps of dt.
double oscillator_error(double rho, double dt) {
  constexpr double w = 5.0, d = 0.5;
  const auto rule = GeneralisedAlpha::of_radius(rho);
  std::vector<Vec3> x{Vec3::UnitX()};
  Rates rates{{Vec3::Zero()}, {-w * w * Vec3::UnitX()}};
  for (int i = 0; i < std::lround(1.0 / dt); ++i) {
    const Motion m = motion_in_step(rule, dt, x, rates);
    // a_0 + c_a u + 2 d (v_0 + c_v u) + w^2 (x_0 + u) = 0
    const double u = -(m.acceleration[0].x() + 2.0 * d * m.velocity[0].x() + w * w * x[0].x()) /
                     (m.acceleration_slope + 2.0 * d * m.velocity_slope + w * w);
    const std::vector<Vec3> end{x[0] + u / (1.0 - rule.alpha_f) * Vec3::UnitX()};
    rates = rates_after(rule, dt, x, rates, end);
    x = end;
  }
  const double f = std::sqrt(w * w - d * d);
  return std::abs(x[0].x() - std::exp(-d) * (std::cos(f) + d / f * std::sin(f)));
}

/// Muscle with all that an implicit wall may have.
implicit::StaticModel everything() {
  solid::CardiacModel heart{.base = {solid::BasalSupport::Kind::fixed, 5.0}};
  heart.myocardium.passive = material::SmoothHolzapfelOgden{.a = 1.0, .k = 10.0};
  implicit::StaticModel model(heart);
  model.compressibility.kappa = 60.0;
  model.heart.surroundings.epicardium = {
      3.0, 0.2, 0.05, 0.01, {solid::AxialWeight::WeightShape::linear, 0.5}};
  model.heart.surroundings.base = solid::Support::in_all_directions(0.7, 0.02);
  model.heart.myocardium.viscosity.eta = 0.08;
  model.density = 1e-3;
  return model;
}

}  // namespace

TEST_CASE("the generalised alpha rule is of second order for every radius", "[unit][implicit]") {
  for (const double rho : {0.0, 0.5, 0.8, 1.0}) {
    const double order = std::log2(oscillator_error(rho, 0.01) / oscillator_error(rho, 0.005));
    CHECK(order == Approx(2.0).margin(0.1));
  }
  CHECK_THROWS_AS(GeneralisedAlpha::of_radius(1.2), InputError);
  CHECK_THROWS_AS(GeneralisedAlpha::of_radius(-0.1), InputError);
}

TEST_CASE("fast waves shrink by the spectral radius", "[unit][implicit]") {
  constexpr double rho = 0.6, dt = 1.0, stiffness = 1e10;
  const auto rule = GeneralisedAlpha::of_radius(rho);
  std::vector<Vec3> x{Vec3::UnitX()};
  Rates rates{{Vec3::Zero()}, {Vec3::Zero()}};
  std::vector<double> sizes;
  for (int i = 0; i < 60; ++i) {
    const Motion m = motion_in_step(rule, dt, x, rates);
    const double u =
        -(m.acceleration[0].x() + stiffness * x[0].x()) / (m.acceleration_slope + stiffness);
    const std::vector<Vec3> end{x[0] + u / (1.0 - rule.alpha_f) * Vec3::UnitX()};
    rates = rates_after(rule, dt, x, rates, end);
    x = end;
    sizes.push_back(std::abs(x[0].x()));
  }
  CHECK(std::pow(sizes[59] / sizes[39], 1.0 / 20.0) == Approx(rho).epsilon(0.06));
}

TEST_CASE("the tangent of a moving wall is the derivative of its residual", "[unit][implicit]") {
  for (const mesh::Mesh& mesh : {test::block_mesh(CellKind::hexahedron, 2),
                                 mesh::refine(test::block_mesh(CellKind::hexahedron, 2)),
                                 mesh::refine(test::block_mesh(CellKind::tetrahedron, 1))}) {
    const Equations equations(mesh, everything());
    test::RandomValues random(3);
    State state = equations.rest();
    Mat3 F;
    F << 1.08, 0.05, -0.02, 0.13, 0.98, 0.04, -0.01, 0.10, 0.97;
    for (Vec3& x : state.positions)
      x = F * x + 0.01 * random.vector();
    for (double& p : state.pressures)
      p = random();
    Rates rates;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      rates.velocity.push_back(random.vector());
      rates.acceleration.emplace_back(10.0 * random.vector());
    }
    const Motion motion = motion_in_step(GeneralisedAlpha::of_radius(0.4), 0.02, mesh.nodes, rates);
    std::vector<double> direction(equations.size());
    for (double& d : direction)
      d = random();
    const auto residual = [&](double by) {
      State s = state;
      for (std::size_t k = 0; k < 3 * s.positions.size(); ++k)
        s.positions[k / 3][static_cast<int>(k % 3)] += by * direction[k];
      for (std::size_t m = 0; m < s.pressures.size(); ++m)
        s.pressures[m] += by * direction[3 * s.positions.size() + m];
      return equations.residual(s, 1.3, equations.steady(0.7), &motion);
    };
    constexpr double h = 1e-5;
    std::vector<double> slope = residual(h);
    const std::vector<double> behind = residual(-h);
    REQUIRE_FALSE(slope.empty());
    REQUIRE_FALSE(behind.empty());
    for (std::size_t k = 0; k < slope.size(); ++k)
      slope[k] = (slope[k] - behind[k]) / (2.0 * h);
    implicit::SparseMatrix K(equations.pattern(), {}, equations.undeformed());
    equations.tangent(state, 1.3, equations.steady(0.7), K, &motion);
    const auto found = K.solve(slope).value();
    double error = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k)
      error = std::max(error, std::abs(found[k] - direction[k]));
    CHECK(error < 1e-5);
  }
}

TEST_CASE("the wall's inertia is its mass times the acceleration", "[unit][implicit]") {
  for (const mesh::Mesh& mesh : {mesh::refine(test::block_mesh(CellKind::hexahedron, 2)),
                                 mesh::refine(test::block_mesh(CellKind::tetrahedron, 1))}) {
    solid::CardiacModel heart{.base = {.stiffness = 0.0}};
    heart.myocardium.active = material::PrescribedTension{0.0};
    implicit::StaticModel model(heart);
    model.density = 2e-3;
    const Equations equations(mesh, model);
    Motion motion;
    motion.from = mesh.nodes;
    motion.velocity.assign(mesh.nodes.size(), Vec3::Zero());
    motion.acceleration.assign(mesh.nodes.size(), Vec3(1.0, -2.0, 3.0));
    const auto R = equations.residual(equations.rest(), 0.0, equations.steady(0.0), &motion);
    Vec3 sum = Vec3::Zero();
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      sum += Vec3(R[3 * a], R[3 * a + 1], R[3 * a + 2]);
    const Vec3 expected = 2e-3 * test::volume(mesh) * Vec3(1.0, -2.0, 3.0);
    CHECK((sum - expected).norm() < 1e-3 * expected.norm());  // sides are not plane
  }
}

/// A half sphere whose base is held by springs and dashpots of its own, quasi-statically or with
/// rates.
TEST_CASE("a base takes a wall without load along as a rigid body", "[unit][implicit]") {
  const verify::HalfSphere sphere;
  const mesh::Mesh mesh = sphere.mesh(4.0, 2);
  solid::CardiacModel heart{.base = {.kind = solid::BasalSupport::Kind::elastic}};
  heart.myocardium.passive = material::NeoHookean{sphere.mu};
  heart.myocardium.active = material::PrescribedTension{0.0};
  heart.surroundings.base = {50.0, 20.0, 0.0, 0.0, {}};
  constexpr int steps = 4;
  const auto at = [&](int n) {
    const double t = static_cast<double>(n) / steps;
    return solid::displacement({3.0 * t, 0.1 * t, -0.05 * t, 0.2 * t},
                               solid::base_frame(mesh, 0.5));
  };
  const solid::AffineField goal = at(steps);
  for (const double dashpots : {0.0, 0.05}) {
    heart.surroundings.base.normal_viscosity = dashpots;
    implicit::TimeEngine time(mesh, implicit::StaticModel(heart), {});
    const double volume = time.cavity_volume();
    for (int i = 0; i < steps; ++i) {
      const auto report = time.advance({.dt = 0.01, .base = {at(i), at(i + 1)}}, [&](double) {
        return implicit::GivenVolume{volume, 0.0};
      });
      INFO("step " << i << ": " << report.why);
      REQUIRE(report.converged);
    }
    double off = 0.0;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      off = std::max(off,
                     (time.state().positions[a] - mesh.nodes[a] - goal.at(mesh.nodes[a])).norm());
    CHECK(off < 1e-5);
    CHECK(std::abs(time.pressure()) < 1e-5);
    CHECK(time.stored_energy() < 1e-8);
  }
}

TEST_CASE("a wall that is filled around a base elsewhere is the filled wall there",
          "[unit][implicit]") {
  const verify::HalfSphere sphere;
  const mesh::Mesh mesh = sphere.mesh(4.0, 2);
  solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  heart.myocardium.passive = material::NeoHookean{sphere.mu};
  heart.myocardium.active = material::PrescribedTension{0.0};
  implicit::TimeEngine here(mesh, implicit::StaticModel(heart), {});
  implicit::TimeEngine there(mesh, implicit::StaticModel(heart), {});
  const double volume = here.fill(0.1, 0.0).value();
  CHECK(there.fill(0.1, 0.0, solid::displacement({-9.0}, {})).value() == Approx(volume));
  double off = 0.0;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    off = std::max(
        off, (there.state().positions[a] - here.state().positions[a] - Vec3(0.0, 0.0, 9.0)).norm());
  CHECK(off < 1e-5);
}

TEST_CASE("a slow step with inertia, or with dashpots alone, ends at the equilibrium",
          "[unit][implicit]") {
  const mesh::Mesh mesh = mesh::refine(test::block_mesh(CellKind::hexahedron, 2));
  solid::CardiacModel heart{.base = {solid::BasalSupport::Kind::fixed, 100.0}};
  heart.myocardium.passive = material::NeoHookean{5.0};
  heart.myocardium.active = material::PrescribedTension{0.0};
  implicit::StaticModel still(heart);
  implicit::Engine engine(mesh, still, {});
  engine.go_to({0.3}).value();
  const implicit::TensionAt none = [](std::size_t, std::size_t, double) {
    return material::Tension{};
  };
  for (const double density : {0.0, 1e-6}) {
    implicit::StaticModel moving = still;
    moving.density = density;
    moving.heart.myocardium.viscosity.eta = 1e-3;
    implicit::TimeEngine time(mesh, moving, {}, 0.0);
    CHECK(time.balance() == 1.0);  // of radius 0: balanced at the end
    for (int i = 0; i < 6; ++i)
      REQUIRE(time.move(10.0, {none, 0.3}).converged);
    double largest = 0.0;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      largest = std::max(largest, (time.state().positions[a] - engine.state().positions[a]).norm());
    CHECK(largest < 1e-5);
    CHECK(time.pressure() == 0.3);
  }
}

/// The cavity must be closed: its volume's derivative leaves out the edge's own motion, which the
/// volume does not feel where the edge stays in the basal plane. The wall meets the volume at
/// balance, so that at the step's end it is off by about (1 - f)/2 V'' dr^2 = 0.006 mm^3, f = 2/3.
TEST_CASE("a given volume is met at the end of a step with inertia", "[unit][implicit]") {
  const verify::HalfSphere sphere;
  const mesh::Mesh mesh = sphere.mesh(4.0, 2);
  solid::CardiacModel heart{.base = {.stiffness = implicit::rigid_base}};
  heart.myocardium.passive = material::NeoHookean{sphere.mu};
  heart.myocardium.active = material::PrescribedTension{0.0};
  implicit::StaticModel model(heart);
  model.density = 1e-6;
  implicit::TimeEngine time(mesh, model, {}, 0.5);
  const double start = time.fill(0.1, 0.0).value();
  for (int i = 1; i <= 5; ++i) {
    const double volume = start + 20.0 * i;
    const auto report = time.advance({.dt = 0.01}, [&](double) {
      return implicit::GivenVolume{volume, 0.0};
    });
    INFO("step " << i << ": " << report.why);
    REQUIRE(report.converged);
    CHECK(time.cavity_volume() == Approx(volume).margin(0.05));
  }
}
