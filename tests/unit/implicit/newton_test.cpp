#include "lv/implicit/newton.hpp"

#include "lv/implicit/give_way.hpp"
#include "lv/mesh/refine.hpp"

#include "support/block_mesh.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;
using implicit::Equations;
using implicit::Newton;
using implicit::NewtonReport;
using implicit::State;

/// A block of rubber whose side at low x a pressure pushes, on a base that is held.
struct Block {
  mesh::Mesh mesh = mesh::refine(test::block_mesh(mesh::CellKind::hexahedron, 2));
  Equations equations{mesh, rubber()};

  static solid::CardiacModel rubber() {
    solid::CardiacModel heart{.base = {solid::BasalSupport::Kind::fixed, 100.0}};
    heart.myocardium.passive = material::NeoHookean{5.0};
    heart.myocardium.active = material::PrescribedTension{0.0};
    return heart;
  }

  /// The largest force that is not balanced [mN].
  [[nodiscard]] double imbalance(const State& state, double pressure) const {
    double largest = 0.0;
    for (const double R : equations.residual(state, {pressure, 0.0}))
      largest = std::max(largest, std::abs(R));
    return largest;
  }
};

double largest_move(const State& a, const State& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.positions.size(); ++i)
    largest = std::max(largest, (a.positions[i] - b.positions[i]).norm());
  return largest;
}

}  // namespace

TEST_CASE("Newton's method balances the wall and tells how", "[unit][implicit]") {
  const Block block;
  Newton newton(block.equations, {});
  State state = block.equations.rest();
  const NewtonReport report = newton.solve(state, {0.5, 0.0});
  CHECK(report.converged);
  CHECK(report.why.empty());
  CHECK(report.iterations > 0);
  CHECK(report.factorisations > 0);
  CHECK(largest_move(state, block.equations.rest()) > 0.01);
  CHECK(block.imbalance(state, 0.5) < 1e-4 * block.imbalance(block.equations.rest(), 0.5));
}

TEST_CASE("a tangent that still serves is kept for the next loads", "[unit][implicit]") {
  const Block block;
  Newton newton(block.equations, {});
  State state = block.equations.rest();
  REQUIRE(newton.solve(state, {0.5, 0.0}).converged);
  NewtonReport next = newton.solve(state, {0.501, 0.0});
  CHECK(next.converged);
  CHECK(next.factorisations == 0);
  newton.forget_tangent();
  next = newton.solve(state, {0.502, 0.0});
  CHECK(next.converged);
  CHECK(next.factorisations > 0);
}

TEST_CASE("where there is no equilibrium the state stays and the report says why",
          "[unit][implicit]") {
  const Block block;
  State state = block.equations.rest();
  const State before = state;
  const NewtonReport hopeless = Newton(block.equations, {}).solve(state, {1e5, 0.0});
  CHECK_FALSE(hopeless.converged);
  CHECK_FALSE(hopeless.why.empty());
  CHECK(largest_move(state, before) == 0.0);

  const NewtonReport hurried = Newton(block.equations, {.iterations = 1}).solve(state, {0.5, 0.0});
  CHECK_FALSE(hurried.converged);
  CHECK_THAT(hurried.why, Catch::Matchers::Contains("no equilibrium after 1 corrections"));
  CHECK(largest_move(state, before) == 0.0);
}

TEST_CASE("a wall that is turned inside out is no start", "[unit][implicit]") {
  const Block block;
  State state = block.equations.rest();
  for (Vec3& x : state.positions)
    x.x() = -x.x();
  const NewtonReport report = Newton(block.equations, {}).solve(state, solid::Loads{});
  CHECK_FALSE(report.converged);
  CHECK_THAT(report.why, Catch::Matchers::Contains("inside out at the start"));
}

TEST_CASE("a wall that gives way comes to rest where Newton's method finds it, or stays",
          "[unit][implicit]") {
  Block block;
  Newton newton(block.equations, {});
  State start = block.equations.rest();
  REQUIRE(newton.solve(start, {0.45, 1.0}).converged);
  State expected = start;
  REQUIRE(newton.solve(expected, {0.5, 1.0}).converged);
  State state = start;
  const auto under = [&](double pressure) -> implicit::Equilibrium {
    return {block.equations.steady(1.0), pressure};
  };
  CHECK(implicit::give_way(block.equations, newton, state, under(0.5)));
  CHECK(largest_move(state, expected) < 1e-4 * largest_move(start, expected));
  CHECK(block.equations.model().density == 0.0);

  state = start;
  CHECK_FALSE(implicit::give_way(block.equations, newton, state, under(1e5)));
  CHECK(largest_move(state, start) == 0.0);
}
