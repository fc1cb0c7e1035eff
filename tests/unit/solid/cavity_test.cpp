#include "lv/solid/cavity.hpp"

#include "mesh/mesh_files.hpp"
#include "support/block_mesh.hpp"
#include "support/random_values.hpp"
#include <catch2/catch.hpp>

using namespace lv;
using mesh::CellKind;

TEST_CASE("the cavity of an ellipsoid has its exact volume, to second order in the edge length",
          "[unit][solid]") {
  const geometry::Ellipsoid ellipsoid;
  const double exact = ellipsoid.enclosed_volume(0.0);
  CHECK(exact == Approx(70790.0).epsilon(1e-3));  // 70.79 ml
  const auto error = [&](double edge) {
    const mesh::Mesh mesh = test::ellipsoid_mesh(ellipsoid, edge, 3);
    return 1.0 - solid::Cavity(mesh).volume(mesh.nodes) / exact;
  };
  const double coarse = error(5.0);
  const double fine = error(2.5);
  CHECK(coarse > 0.0);  // faces cut the corners
  CHECK(coarse < 0.05);
  CHECK(coarse / fine > 3.0);  // 4, but the number of elements is whole
  CHECK(coarse / fine < 5.0);
}

TEST_CASE("the cavity's volume changes with det F and not with rigid motions", "[unit][solid]") {
  Mat3 F;
  F << 1.1, 0.05, 0.0, -0.1, 0.95, 0.03, 0.02, 0.0, 1.02;
  for (const CellKind kind : {CellKind::hexahedron, CellKind::tetrahedron}) {
    const mesh::Mesh mesh = test::coarse_mesh(kind);
    const solid::Cavity cavity(mesh);
    const double V = cavity.volume(mesh.nodes);
    CHECK(cavity.volume(test::moved(mesh.nodes, test::RandomValues(1).rotation(), {70, -20, 90})) ==
          Approx(V).epsilon(1e-12));
    CHECK(cavity.volume(test::moved(mesh.nodes, F)) == Approx(determinant(F) * V).epsilon(1e-12));
  }
}

TEST_CASE("splitting hexahedra in tetrahedra changes the cavity little", "[unit][solid]") {
  const mesh::Mesh hexahedra = test::coarse_mesh(CellKind::hexahedron);
  const mesh::Mesh tetrahedra = test::coarse_mesh(CellKind::tetrahedron);
  CHECK(solid::Cavity(tetrahedra).volume(tetrahedra.nodes) ==
        Approx(solid::Cavity(hexahedra).volume(hexahedra.nodes)).epsilon(0.01));
}
