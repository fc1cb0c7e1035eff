#include "lv/immersed/coupling.hpp"

#include "lv/immersed/quadrature_coupling.hpp"

#include "support/block_mesh.hpp"
#include "support/cell_kinds.hpp"
#include "support/fluid_fields.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;
using fluid::FaceField;
using fluid::Grid;
using immersed::CouplingKind;
using immersed::CouplingParameters;
using immersed::Kernel;
using mesh::CellKind;
using mesh::Mesh;
using test::kinds;

/// A box around the block of cells 2 mm wide, with a grid as wide as them or half.
Grid box(double spacing) {
  const int cells = static_cast<int>(24.0 / spacing);
  return {{cells, cells, cells}, {6.0, -5.0, -15.0}, Vec3::Constant(spacing)};
}

/// All couplings, on meshes of both kinds, with quadratures from the coarsest to five points per
/// edge. Calls check(coupling, mesh, grid).
template <class Check>
void for_couplings(const Check& check) {
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::block_mesh(kind);
    for (const double spacing : {1.0, 2.0}) {
      const Grid grid = box(spacing);
      for (const auto coupling : {CouplingKind::nodal, CouplingKind::quadrature}) {
        for (const double points_per_cell : {0.5, 2.0}) {
          INFO("hexahedra " << (kind == kinds[0]) << ", spacing " << grid.spacing[0] << ", nodal "
                            << (coupling == CouplingKind::nodal) << ", points per cell "
                            << points_per_cell);
          const auto made = immersed::make_coupling({coupling, Kernel::peskin4, points_per_cell},
                                                    mesh, grid, test::whole_box(grid));
          check(*made, mesh, grid);
        }
      }
    }
  }
}

/// The block a little deformed, so that it differs from its reference.
std::vector<Vec3> deformed(const Mesh& mesh) {
  Mat3 F;
  F << 1.1, 0.1, 0.0, -0.05, 0.95, 0.0, 0.0, 0.1, 1.05;
  const Vec3 centre(18, 7, -3);
  return test::displaced(test::moved(mesh.nodes, F, centre - F * centre),
                         test::RandomValues(3).vectors(mesh.nodes.size(), 0.1), 1.0);
}

Vec3 resultant(FaceField& density, const Grid& grid) {
  Vec3 sum = Vec3::Zero();
  for (int c = 0; c < 3; ++c)
    test::for_points(density.component[c], 0,
                     [&](int, int, int, double& f) { sum[c] += grid.cell_volume() * f; });
  return sum;
}

Vec3 torque(FaceField& density, const Grid& grid) {
  Vec3 sum = Vec3::Zero();
  for (int c = 0; c < 3; ++c)
    test::for_points(density.component[c], 0, [&](int i, int j, int k, double& f) {
      sum += grid.cell_volume() * f * grid.face(c, i, j, k).cross(Vec3::Unit(c));
    });
  return sum;
}

}  // namespace

TEST_CASE("couplings spread and interpolate adjointly", "[unit][immersed]") {
  for_couplings([](const immersed::Coupling& coupling, const Mesh& mesh, const Grid& grid) {
    const auto positions = deformed(mesh);
    const auto forces = test::RandomValues(1).vectors(positions.size(), 1.0);
    const FaceField u = test::random_field(grid, 2);
    FaceField density(grid, test::whole_box(grid));
    coupling.spread(positions, forces, density);
    std::vector<Vec3> velocities(positions.size());
    coupling.interpolate(u, positions, velocities);
    double size = 0.0;
    for (std::size_t a = 0; a < forces.size(); ++a)
      size += forces[a].norm() * velocities[a].norm();
    // the mass matrix is solved to 1e-12
    CHECK(test::product(density, u) * grid.cell_volume() ==
          Approx(test::work(forces, velocities)).margin(1e-11 * size));
  });
}

TEST_CASE("couplings conserve the force", "[unit][immersed]") {
  for_couplings([](const immersed::Coupling& coupling, const Mesh& mesh, const Grid& grid) {
    const auto positions = deformed(mesh);
    const auto forces = test::RandomValues(4).vectors(positions.size(), 1.0);
    FaceField density(grid, test::whole_box(grid));
    coupling.spread(positions, forces, density);
    CHECK((resultant(density, grid) - test::resultant(forces)).norm() <
          1e-11 * test::magnitude(forces));
  });
}

TEST_CASE("couplings move the wall with a blood that moves as a whole", "[unit][immersed]") {
  for_couplings([](const immersed::Coupling& coupling, const Mesh& mesh, const Grid& grid) {
    const auto positions = deformed(mesh);
    const Vec3 U(30, -20, 10);
    std::vector<Vec3> velocities(positions.size());
    coupling.interpolate(test::field_of(grid, [&](int c, const Vec3&) { return U[c]; }), positions,
                         velocities);
    for (const Vec3& V : velocities)
      CHECK((V - U).norm() < 1e-10 * U.norm());
  });
}

TEST_CASE("couplings conserve the torque and rotate the wall with the blood", "[unit][immersed]") {
  // four points per edge and more integrate products of shape functions as exactly as the mass
  const Mat3 spin{{0, -3, 2}, {3, 0, -1}, {-2, 1, 0}};
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::block_mesh(kind);
    const Grid grid = box(1.0);
    const auto positions = deformed(mesh);
    const auto forces = test::RandomValues(5).vectors(positions.size(), 1.0);
    const FaceField u =
        test::field_of(grid, [&](int c, const Vec3& x) { return spin.row(c).dot(x); });
    for (const auto coupling_kind : {CouplingKind::nodal, CouplingKind::quadrature}) {
      const auto coupling = immersed::make_coupling({coupling_kind, Kernel::peskin4, 2.0}, mesh,
                                                    grid, test::whole_box(grid));
      FaceField density(grid, test::whole_box(grid));
      coupling->spread(positions, forces, density);
      CHECK((torque(density, grid) - test::torque(positions, forces)).norm() <
            1e-11 * 25.0 * test::magnitude(forces));  // arms of 25 mm
      std::vector<Vec3> velocities(positions.size());
      coupling->interpolate(u, positions, velocities);
      for (std::size_t a = 0; a < positions.size(); ++a)
        CHECK((velocities[a] - spin * positions[a]).norm() <
              1e-8);  // 60 mm/s, the mass solved to 1e-12
    }
  }
}

TEST_CASE("quadrature points multiply as elements stretch", "[unit][immersed]") {
  const Mesh mesh = test::block_mesh(CellKind::hexahedron);
  const Grid grid = box(1.0);
  const immersed::Transfer transfer(grid, test::whole_box(grid), Kernel::peskin4);
  const immersed::QuadratureCoupling coupling(mesh, transfer, 1.0, 2.0);
  const std::size_t before = coupling.point_count(mesh.nodes);
  CHECK(before >= 27 * 4 * 4 * 4);  // cells 2 mm wide, two points per mm
  const Mat3 stretch = Vec3(3.0, 1.0, 1.0).asDiagonal();
  const std::size_t after = coupling.point_count(test::moved(mesh.nodes, stretch));
  CHECK(after > 2 * before);
  CHECK(after < 4 * before);
}
