#include "lv/mesh/refine.hpp"

#include "lv/mesh/cell.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/mesh/split.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/solid/endocardial_surface.hpp"

#include "mesh_io/mesh_files.hpp"
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace lv;
using mesh::CellKind;
using mesh::Mesh;

double smallest_jacobian(const Mesh& mesh) {
  double smallest = 1e9;
  for (int c = 0; c < mesh.cell_count(); ++c)
    smallest = std::min(smallest, mesh::smallest_jacobian(mesh, c));
  return smallest;
}

/// A linear field, which interpolation must keep.
void set_infarct(Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    mesh.infarct[i] = -0.01 * mesh.nodes[i].z();
}

}  // namespace

TEST_CASE("refining keeps the wall and multiplies its cells by eight", "[unit][mesh]") {
  for (const auto kind : {CellKind::hexahedron, CellKind::tetrahedron}) {
    const Mesh coarse = test::coarse_mesh(kind);
    const Mesh fine = mesh::refine(coarse);
    CHECK(fine.cell_count() == 8 * coarse.cell_count());
    CHECK(fine.endo.size() == 4 * coarse.endo.size());
    CHECK(fine.epi.size() == 4 * coarse.epi.size());
    CHECK(fine.base.size() == 4 * coarse.base.size());
    CHECK(smallest_jacobian(fine) > 0.0);
    // straight edges and bilinear faces stay what they are, so volumes agree to rounding
    CHECK(mesh::quality(fine).wall_volume ==
          Approx(mesh::quality(coarse).wall_volume).epsilon(1e-12));
    CHECK(solid::EndocardialSurface(fine).volume(fine.nodes) ==
          Approx(solid::EndocardialSurface(coarse).volume(coarse.nodes)).epsilon(1e-12));
  }
}

TEST_CASE("the parts of bent quadratic elements share the elements' volume", "[unit][mesh]") {
  for (const auto kind : {CellKind::hexahedron, CellKind::tetrahedron}) {
    Mesh mesh = mesh::refine(test::coarse_mesh(kind));
    const std::vector<double> straight = mesh::cell_volumes(mesh);
    for (Vec3& X : mesh.nodes)  // which quadratic elements follow exactly, and keeps volumes
      X.z() += 0.1 * X.x() * X.x();
    const std::vector<double> bent = mesh::cell_volumes(mesh);
    double off = 0.0;
    for (int c = 0; c < mesh.cell_count(); ++c) {
      CHECK(bent[c] == Approx(straight[c]).epsilon(1e-10));
      off = std::max(off, std::abs(mesh::cell_volume(mesh, c) / straight[c] - 1.0));
    }
    CHECK(off > 0.01);  // of the parts with straight edges
  }
}

TEST_CASE("a refined wall is closed by its refined sides and hangs together", "[unit][mesh]") {
  for (const auto kind : {CellKind::hexahedron, CellKind::tetrahedron}) {
    const Mesh fine = mesh::refine(test::coarse_mesh(kind));
    CHECK(mesh::boundary(fine).size() == fine.endo.size() + fine.epi.size() + fine.base.size());
    double enclosed = 0.0;
    for (const mesh::Surface* side : {&fine.endo, &fine.epi, &fine.base})
      enclosed += mesh::signed_volume(fine.nodes, *side, {1.0, 2.0, 3.0});
    CHECK(enclosed == Approx(mesh::quality(fine).wall_volume).epsilon(1e-12));
    CHECK(mesh::edge_loops(fine.endo) == 1);
    CHECK(mesh::edge_loops(fine.base) == 2);
    CHECK(mesh::count_parts(mesh::cell_parts(fine)) == 1);
    CHECK(mesh::crowded_faces(fine).empty());
  }
}

TEST_CASE("refining keeps the base plane, t on the sides and linear fields", "[unit][mesh]") {
  for (const auto kind : {CellKind::hexahedron, CellKind::tetrahedron}) {
    Mesh coarse = test::coarse_mesh(kind);
    set_infarct(coarse);
    const Mesh fine = mesh::refine(coarse);
    for (const int node : fine.base.nodes)
      REQUIRE(fine.nodes[node].z() == 0.0);
    for (const int node : fine.endo.nodes)
      REQUIRE(fine.transmural[node] == 0.0);
    for (const int node : fine.epi.nodes)
      REQUIRE(fine.transmural[node] == 1.0);
    REQUIRE(fine.infarct.size() == fine.nodes.size());
    for (std::size_t i = 0; i < fine.nodes.size(); ++i)
      REQUIRE(fine.infarct[i] == Approx(-0.01 * fine.nodes[i].z()).margin(1e-12));
    for (std::size_t i = 0; i < coarse.nodes.size(); ++i)
      REQUIRE(fine.nodes[i] == coarse.nodes[i]);
  }
}

TEST_CASE("refining tetrahedra again and again keeps their shape bounded", "[unit][mesh]") {
  const Mesh coarse = test::coarse_mesh(CellKind::tetrahedron);
  const Mesh once = mesh::refine(coarse);
  const Mesh twice = mesh::refine(once);
  const double first = mesh::quality(once).scaled_jacobian.min;
  CHECK(first > 0.25 * mesh::quality(coarse).scaled_jacobian.min);
  CHECK(mesh::quality(twice).scaled_jacobian.min >
        0.99 * first);  // similar children after the first
}

TEST_CASE("hexahedra split into tetrahedra that fill the same wall", "[unit][mesh]") {
  const Mesh hexahedra = test::coarse_mesh(CellKind::hexahedron);
  const Mesh tetrahedra = mesh::split_into_tetrahedra(hexahedra);
  CHECK(tetrahedra.cell_count() == 6 * hexahedra.cell_count());
  CHECK(smallest_jacobian(tetrahedra) > 0.0);
  CHECK(mesh::boundary(tetrahedra).size() ==
        tetrahedra.endo.size() + tetrahedra.epi.size() + tetrahedra.base.size());
  double enclosed = 0.0;
  for (const mesh::Surface* side : {&tetrahedra.endo, &tetrahedra.epi, &tetrahedra.base})
    enclosed += mesh::signed_volume(tetrahedra.nodes, *side, {1.0, 2.0, 3.0});
  CHECK(enclosed == Approx(mesh::quality(tetrahedra).wall_volume).epsilon(1e-12));
}
