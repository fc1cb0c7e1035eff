#include "lv/solid/boundary.hpp"

#include "lv/mesh/surface.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/block_mesh.hpp"
#include "support/cell_kinds.hpp"
#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using mesh::CellKind;
using mesh::Mesh;
using test::kinds;

}  // namespace

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
}
