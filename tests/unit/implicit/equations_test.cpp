#include "lv/base/check.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/implicit/engine.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh/wall_mesh.hpp"
#include "lv/verify/small_ventricle.hpp"

#include "support/block_mesh.hpp"
#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <set>

namespace {

using namespace lv;
using implicit::Equations;
using implicit::LinearMethod;
using implicit::State;
using mesh::CellKind;
using mesh::Mesh;
using solid::CardiacModel;
using solid::Loads;

/// One mesh of every kind of element.
std::vector<Mesh> meshes() {
  return {test::block_mesh(CellKind::hexahedron, 2),
          mesh::refine(test::block_mesh(CellKind::hexahedron, 2)),
          mesh::refine(test::block_mesh(CellKind::tetrahedron, 1))};
}

/// Contracting muscle of the paper on a base that is held.
CardiacModel contracting() {
  return {.base = {solid::BasalSupport::Kind::fixed, 50.0}};
}

State displaced(const State& from, std::span<const double> by, double scale) {
  State to = from;
  for (std::size_t k = 0; k < 3 * to.positions.size(); ++k)
    to.positions[k / 3][static_cast<int>(k % 3)] += scale * by[k];
  for (std::size_t m = 0; m < to.pressures.size(); ++m)
    to.pressures[m] += scale * by[3 * to.positions.size() + m];
  return to;
}

/// A state near no symmetry and far from rest.
State some_state(const Equations& equations, test::RandomValues& random) {
  State s = equations.rest();
  Mat3 F;
  F << 1.08, 0.05, -0.02, 0.13, 0.98, 0.04, -0.01, 0.10, 0.97;
  for (Vec3& x : s.positions)
    x = F * x + 0.01 * random.vector();
  for (double& p : s.pressures)
    p = random();
  return s;
}

}  // namespace

TEST_CASE("the tangent is the derivative of the residual", "[unit][implicit]") {
  const Loads loads{1.3, 0.7};
  for (Mesh& mesh : meshes()) {
    mesh.segment.assign(static_cast<std::size_t>(mesh.cell_count()), 2);  // all is septum
    auto muscle = contracting();
    muscle.septal_pressure = 0.4;
    const Equations equations(mesh, muscle);
    test::RandomValues random(3);
    const State state = some_state(equations, random);
    std::vector<double> direction(equations.size());
    for (double& d : direction)
      d = random();
    constexpr double h = 1e-5;
    const auto ahead = equations.residual(displaced(state, direction, h), loads);
    const auto behind = equations.residual(displaced(state, direction, -h), loads);
    REQUIRE_FALSE(ahead.empty());
    REQUIRE_FALSE(behind.empty());
    std::vector<double> slope(ahead.size());
    for (std::size_t k = 0; k < slope.size(); ++k)
      slope[k] = (ahead[k] - behind[k]) / (2.0 * h);

    implicit::SparseMatrix K(equations.pattern(), {}, equations.undeformed());
    equations.tangent(state, loads, K);
    const auto found = K.solve(slope).value();
    double error = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k)
      error = std::max(error, std::abs(found[k] - direction[k]));
    CHECK(error < 1e-5);
  }
}

TEST_CASE("both linear solvers give the same correction", "[unit][implicit]") {
  const Mesh mesh = verify::ideal_mesh({.edge_length = 6.0, .layers = 2, .order = 2});
  CardiacModel held{.base = {.stiffness = implicit::rigid_base}};
  held.myocardium.active = material::PrescribedTension{0.0};
  const Equations equations(mesh, held);
  const auto R = equations.residual(equations.rest(), {0.1, 0.0});
  std::array<std::vector<double>, 2> found;
  for (const auto method : {LinearMethod::direct, LinearMethod::iterative}) {
    implicit::SparseMatrix K(equations.pattern(), {.method = method, .tolerance = 1e-9},
                             equations.undeformed());
    equations.tangent(equations.rest(), {0.1, 0.0}, K);
    found[method == LinearMethod::iterative] = K.solve(R).value();
  }
  double largest = 0.0, difference = 0.0;
  for (int k = 0; k < 3 * equations.node_count(); ++k) {
    largest = std::max(largest, std::abs(found[0][k]));
    difference = std::max(difference, std::abs(found[0][k] - found[1][k]));
  }
  CHECK(largest > 0.01);
  CHECK(difference < 1e-4 * largest);
}

TEST_CASE("an isochoric uniform deformation is in balance inside the wall", "[unit][implicit]") {
  Mat3 F;
  F << 1.2, 0.1, 0.0, 0.0, 1.0 / 1.2, 0.05, 0.0, 0.0, 1.0;
  for (const Mesh& mesh : meshes()) {
    CardiacModel rubber;
    rubber.myocardium.passive = material::NeoHookean{3.0};
    rubber.myocardium.active = material::PrescribedTension{0.0};
    const Equations equations(mesh, rubber);
    State state = equations.rest();
    state.positions = test::moved(mesh.nodes, F);
    const auto R = equations.residual(state, {});
    std::set<int> outside;
    for (const int node : mesh::surface_nodes(mesh::boundary(mesh)))
      outside.insert(node);
    for (int a = 0; a < equations.node_count(); ++a)
      for (int i = 0; i < 3; ++i)
        if (outside.count(a) == 0)
          CHECK(std::abs(R[3 * a + i]) < 1e-12);
    for (int k = 3 * equations.node_count(); k < equations.size(); ++k)
      CHECK(std::abs(R[k]) < 1e-12);  // J = 1
  }
}

TEST_CASE("quadratic elements fill the wall and follow its surfaces", "[unit][implicit]") {
  const geometry::Ellipsoid ellipsoid;
  const auto wall = [&](double u, double theta, double t) { return ellipsoid.point(u, theta, t); };
  const Mesh mesh = mesh::wall_mesh(wall, {.edge_length = 4.0, .order = 2});
  CHECK(mesh.cell_count() % 8 == 0);
  const auto reference = implicit::reference_wall(mesh);
  double volume = 0.0;
  for (const auto& element : reference.points)
    for (const auto& point : element)
      volume += point.volume;
  CHECK(volume == Approx(114240.0).epsilon(1e-3));
  CHECK(solid::EndocardialSurface(mesh).volume(mesh.nodes) == Approx(70790.0).epsilon(1e-3));
}

TEST_CASE("cells have the stress of the elements they are parts of", "[unit][implicit]") {
  Mat3 F;
  F << 1.1, 0.05, 0.0, 0.02, 0.95, 0.04, 0.0, 0.03, 0.9;
  F /= std::cbrt(F.determinant());
  constexpr double p = -7.0;  // the elements' tension that holds J = 1
  for (const Mesh& mesh : meshes()) {
    CardiacModel rubber = contracting();
    rubber.myocardium.passive = material::NeoHookean{5.0};
    const Equations equations(mesh, rubber);
    State s = equations.rest();
    for (Vec3& x : s.positions)
      x = F * x;
    const bool is_hexahedron = mesh.kind == CellKind::hexahedron;
    const std::size_t per_element = is_hexahedron ? (mesh.order == 2 ? 4 : 1) : 1;
    for (std::size_t m = 0; m < s.pressures.size(); m += per_element)
      s.pressures[m] = p;  // the constant mode of each hexahedron; every corner of tetrahedra
    const auto stress = equations.cell_stress(s, equations.steady(1.0));
    REQUIRE(stress.size() == static_cast<std::size_t>(mesh.cell_count()));
    const Mat3 P = material::NeoHookean{5.0}.stress(F);
    double tension = 0.0, volume = 0.0;
    for (int c = 0; c < mesh.cell_count(); ++c) {
      CHECK(stress[c].pressure == Approx(-p).epsilon(1e-9));
      CHECK((stress[c].cauchy_passive - P * F.transpose()).norm() < 1e-9);
      CHECK(stress[c].cauchy_active.trace() > 0.0);
      tension += mesh::cell_volume(mesh, c) * stress[c].tension;
      volume += mesh::cell_volume(mesh, c);
    }
    CHECK(tension / volume ==
          Approx(equations.mean_tension(s, equations.steady(1.0))).epsilon(0.02));
  }
}

TEST_CASE("linear tetrahedra are refused", "[unit][implicit]") {
  const Mesh mesh = test::block_mesh(CellKind::tetrahedron, 1);
  CHECK_THROWS_AS(implicit::reference_wall(mesh), InputError);
}

TEST_CASE("a factor of all segments is one of the law's strength, and of one of them is local",
          "[unit][implicit]") {
  Mesh mesh = mesh::refine(test::block_mesh(CellKind::hexahedron, 2));
  mesh.segment.assign(mesh.cell_count(), 3);
  CardiacModel weak = contracting();
  weak.myocardium.active = material::NiedererHunterSmith{.T_scale = 1.5};
  CardiacModel half = contracting();
  half.contractility.fill(0.5);
  const Loads loads{1.0, 0.7};
  const Equations by_law(mesh, weak);
  Equations by_factor(mesh, half);
  test::RandomValues random(5);
  const State state = some_state(by_law, random);
  const auto expected = by_law.residual(state, loads);
  const auto R = by_factor.residual(state, loads);
  for (std::size_t k = 0; k < R.size(); ++k)
    CHECK(R[k] == Approx(expected[k]).epsilon(1e-6).margin(1e-6));
  const double mean = by_factor.mean_tension(state, by_factor.steady(0.7));
  CHECK(mean == Approx(by_law.mean_tension(state, by_law.steady(0.7))));
  half.contractility.fill(1.0);
  half.contractility[1] = 0.0;  // no cell is of segment 2
  by_factor.set_model(half);
  CHECK(by_factor.mean_tension(state, by_factor.steady(0.7)) == Approx(2.0 * mean));
}
