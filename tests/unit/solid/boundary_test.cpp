#include "lv/solid/boundary.hpp"

#include "lv/mesh/surface.hpp"
#include "lv/solid/cavity.hpp"

#include "mesh/mesh_files.hpp"
#include "support/block_mesh.hpp"
#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using mesh::CellKind;
using mesh::Mesh;

constexpr std::array kinds{CellKind::hexahedron, CellKind::tetrahedron};

std::vector<Vec3> pressure_forces(const mesh::Surface& surface, double pressure,
                                  std::span<const Vec3> positions) {
  std::vector<Vec3> forces(positions.size(), Vec3::Zero());
  solid::add_pressure_forces(surface, pressure, positions, forces);
  return forces;
}

/// d/dh of a cubic polynomial of h, exactly.
template <class Function>
double slope_of_cubic(const Function& f) {
  const auto difference = [&](double h) { return (f(h) - f(-h)) / (2.0 * h); };
  return (4.0 * difference(0.5) - difference(1.0)) / 3.0;
}

/// Displacements that leave the edge of the endocardium at the base where it is.
std::vector<Vec3> displacements_off_the_edge(const Mesh& mesh, test::RandomValues& random) {
  auto displacements = random.vectors(mesh.nodes.size(), 1.0);
  for (const auto& side : mesh::boundary_edges(mesh.endo))
    displacements[side[0]] = displacements[side[1]] = Vec3::Zero();
  return displacements;
}

}  // namespace

TEST_CASE("pressure on a closed surface has no resultant and no torque", "[unit][solid]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::block_mesh(kind);
    const auto forces = pressure_forces(mesh::boundary(mesh), 8.0, mesh.nodes);
    const double size = test::magnitude(forces);
    CHECK(size > 100.0);
    CHECK(test::resultant(forces).norm() < 1e-14 * size);
    CHECK(test::torque(mesh.nodes, forces).norm() < 1e-14 * 20.0 * size);  // arms of 20 mm
  }
}

TEST_CASE("pressure on a closed surface works against its volume", "[unit][solid]") {
  test::RandomValues random(1);
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::block_mesh(kind);
    const mesh::Surface surface = mesh::boundary(mesh);
    const auto forces = pressure_forces(surface, 8.0, mesh.nodes);
    for (int i = 0; i < 5; ++i) {
      const auto direction = random.vectors(mesh.nodes.size(), 1.0);
      const double dV = slope_of_cubic([&](double h) {
        return mesh::signed_volume(test::displaced(mesh.nodes, direction, h), surface,
                                   Vec3::Zero());
      });
      CHECK(test::work(forces, direction) ==
            Approx(-8.0 * dV).epsilon(1e-11).margin(1e-13 * test::magnitude(forces)));
    }
  }
}

TEST_CASE("the work of the cavity's pressure is p dV", "[unit][solid]") {
  test::RandomValues random(2);
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    const solid::Cavity cavity(mesh);
    const auto forces = pressure_forces(mesh.endo, 1.07, mesh.nodes);
    for (int i = 0; i < 5; ++i) {
      const auto direction = displacements_off_the_edge(mesh, random);
      const double dV = slope_of_cubic(
          [&](double h) { return cavity.volume(test::displaced(mesh.nodes, direction, h)); });
      CHECK(test::work(forces, direction) ==
            Approx(1.07 * dV).epsilon(1e-10).margin(1e-12 * test::magnitude(forces)));
    }
  }
}

TEST_CASE("the pressure follows the surface as it turns", "[unit][solid]") {
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  const Mat3 Q = test::RandomValues(3).rotation();
  const auto forces = pressure_forces(mesh.endo, 1.0, mesh.nodes);
  const auto turned = pressure_forces(mesh.endo, 1.0, test::moved(mesh.nodes, Q, {5, 6, 7}));
  for (std::size_t a = 0; a < forces.size(); ++a)
    CHECK((turned[a] - Q * forces[a]).norm() < 1e-12);  // forces of 10 mN, positions of 80 mm
}

TEST_CASE("pressure in the cavity pushes the wall out and the apex down", "[unit][solid]") {
  const Mesh mesh = test::coarse_mesh(CellKind::tetrahedron);
  const auto forces = pressure_forces(mesh.endo, 1.0, mesh.nodes);
  double outwards = 0.0;
  for (std::size_t a = 0; a < forces.size(); ++a)
    outwards += forces[a].dot(Vec3(mesh.nodes[a].x(), mesh.nodes[a].y(), 0.0));
  CHECK(outwards > 0.0);
  // p times the basal opening; a polygon in the circle of radius 19.5 sqrt(1 - (20/60)^2)
  const double opening = M_PI * 19.5 * 19.5 * (1.0 - 1.0 / 9.0);
  CHECK(test::resultant(forces).z() < 0.0);
  CHECK(-test::resultant(forces).z() == Approx(opening).epsilon(0.03));
}

TEST_CASE("the base resists axial and circumferential motion in proportion to its area",
          "[unit][solid]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    const solid::BasalPenalty base(mesh, {.stiffness = 100.0});
    const double area = mesh::area(mesh.nodes, mesh.base);
    std::vector<Vec3> forces(mesh.nodes.size(), Vec3::Zero());
    const std::vector<Vec3> lifted = test::moved(mesh.nodes, Mat3::Identity(), {0, 0, 0.5});
    base.add_forces(lifted, forces);
    CHECK((test::resultant(forces) - Vec3(0, 0, -100.0 * area * 0.5)).norm() < 1e-10 * area);
    CHECK(base.largest_axial_displacement(lifted) == Approx(0.5).epsilon(1e-12));

    // by 1e-6 rad about the long axis: a torque of -kappa int R^2 dA times the angle
    std::fill(forces.begin(), forces.end(), Vec3::Zero());
    Mat3 turn = Mat3::Identity();
    turn(0, 1) = -1e-6;
    turn(1, 0) = 1e-6;
    base.add_forces(test::moved(mesh.nodes, turn), forces);
    double resisted = 0.0;
    for (const int a : mesh::surface_nodes(mesh.base))
      resisted += forces[a].dot(Vec3(-mesh.nodes[a].y(), mesh.nodes[a].x(), 0.0));
    // int R^2 dA of the basal ring between the radii at z = 0, on a coarse polygon
    const double inner = 19.5 * std::sqrt(1.0 - std::pow(20.0 / 60.0, 2));
    const double outer = 30.0 * std::sqrt(1.0 - std::pow(20.0 / 69.0, 2));
    const double moment = M_PI / 2.0 * (std::pow(outer, 4) - std::pow(inner, 4));
    CHECK(resisted == Approx(-100.0 * moment * 1e-6).epsilon(0.06));
  }
}

TEST_CASE("the base is free to move radially, and the rest of the wall to move at all",
          "[unit][solid]") {
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  const solid::BasalPenalty base(mesh, {.stiffness = 100.0});
  std::vector<Vec3> forces(mesh.nodes.size(), Vec3::Zero());
  Mat3 widen = Mat3::Identity();
  widen(0, 0) = widen(1, 1) = 1.2;
  base.add_forces(test::moved(mesh.nodes, widen), forces);
  CHECK(test::magnitude(forces) < 1e-9);  // 100 kPa/mm, areas of 50 mm^2, 1e-15 of 6 mm

  auto positions =
      test::displaced(mesh.nodes, test::RandomValues(4).vectors(mesh.nodes.size(), 1.0), 1.0);
  for (const int a : mesh::surface_nodes(mesh.base))
    positions[a] = mesh.nodes[a];
  std::fill(forces.begin(), forces.end(), Vec3::Zero());
  base.add_forces(positions, forces);
  CHECK(test::magnitude(forces) == 0.0);
  CHECK(base.largest_axial_displacement(positions) == 0.0);
}
