#include "lv/mesh/curved.hpp"

#include "lv/mesh/cell.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include "mesh_io/mesh_files.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace {

using namespace lv;
using mesh::CellKind;
using mesh::Mesh;

/// Half a hollow sphere of radius 20 to 30 mm of few quadratic elements.
Mesh shell() {
  const auto wall = [](double u, double theta, double t) {
    const double r = (20.0 + 10.0 * t) * std::sin(0.5 * std::numbers::pi * u);
    return Vec3(r * std::cos(theta), r * std::sin(theta),
                -(20.0 + 10.0 * t) * std::cos(0.5 * std::numbers::pi * u));
  };
  return mesh::wall_mesh(wall, {.edge_length = 12.0, .order = 2});
}

/// How far a surface's nodes and the middles of its faces' sides are from a sphere, at most.
double off(const Mesh& m, const mesh::Surface& surface, double radius) {
  double largest = 0.0;
  for (int f = 0; f < surface.size(); ++f) {
    const auto face = surface.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vec3 middle = 0.5 * (m.nodes[face[i]] + m.nodes[face[(i + 1) % face.size()]]);
      largest = std::max(largest, std::abs(middle.norm() - radius));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("parts of quadratic elements follow their curve", "[unit][mesh]") {
  const Mesh coarse = shell();
  const mesh::CurvedMesh fine = mesh::curved(coarse);
  CHECK(fine.mesh.cell_count() == 8 * coarse.cell_count());
  CHECK(fine.mesh.epi.size() == 4 * coarse.epi.size());
  CHECK(fine.cells_per_element == 64);
  CHECK(fine.faces_per_side == 16);
  for (int c = 0; c < fine.mesh.cell_count(); ++c)
    REQUIRE(mesh::smallest_jacobian(fine.mesh, c) > 0.0);
  // chords half as long are a quarter as far from their arc
  CHECK(off(fine.mesh, fine.mesh.epi, 30.0) < 0.4 * off(coarse, coarse.epi, 30.0));
}

TEST_CASE("a linear field on straight quadratic elements is exact at all nodes of the drawn cells",
          "[unit][mesh]") {
  for (const auto kind : {CellKind::hexahedron, CellKind::tetrahedron}) {
    const Mesh coarse = mesh::refine(test::coarse_mesh(kind));
    const mesh::CurvedMesh fine = mesh::curved(coarse);
    const auto linear = [](const Vec3& x) { return 1.0 + 2.0 * x.x() - x.y() + 3.0 * x.z(); };
    std::vector<double> nodal;
    for (const Vec3& x : coarse.nodes)
      nodal.push_back(linear(x));
    const auto values = fine.at_nodes(nodal);
    REQUIRE(values.size() == fine.mesh.nodes.size());
    for (std::size_t a = 0; a < values.size(); ++a)
      CHECK(values[a] == Approx(linear(fine.mesh.nodes[a])).margin(1e-9));
    for (std::size_t a = 0; a < coarse.nodes.size(); ++a)
      CHECK((fine.mesh.nodes[a] - coarse.nodes[a]).norm() < 1e-12);
  }
}

TEST_CASE("linear elements are drawn as they are", "[unit][mesh]") {
  const Mesh coarse = test::coarse_mesh(CellKind::hexahedron);
  const mesh::CurvedMesh same = mesh::curved(coarse);
  CHECK(same.mesh.cells == coarse.cells);
  CHECK(same.at_nodes(coarse.nodes) == coarse.nodes);
  CHECK(same.cells_per_element == 1);
}
