#include "lv/mesh/surface.hpp"

#include "mesh_io/mesh_files.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;

/// A row of unit cubes along x; with `gap`, the last one does not touch the others.
mesh::Mesh cubes(int count, bool gap = false) {
  mesh::Mesh mesh;
  for (int i = 0; i <= count; ++i)
    for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      mesh.nodes.emplace_back(i, y, z);
  const auto add = [&](int left, int right) {
    mesh.cells.insert(mesh.cells.end(),
                      {left, right, right + 1, left + 1, left + 3, right + 3, right + 2, left + 2});
  };
  for (int i = 0; i < count - (gap ? 1 : 0); ++i)
    add(4 * i, 4 * i + 4);
  if (!gap)
    return mesh;
  const int first = static_cast<int>(mesh.nodes.size());
  for (int a = 0; a < 4; ++a)
    mesh.nodes.push_back(mesh.nodes[4 * (count - 1) + a]);
  add(first, 4 * count);
  return mesh;
}

}  // namespace

TEST_CASE("the boundary of a row of cubes has its area, volume and outward normals",
          "[unit][mesh]") {
  const mesh::Mesh mesh = cubes(3);
  const mesh::Surface surface = mesh::boundary(mesh);
  CHECK(surface.size() == 14);
  CHECK(mesh::area(mesh.nodes, surface) == Approx(14.0));
  CHECK(mesh::signed_volume(mesh.nodes, surface, {7.0, 8.0, 9.0}) == Approx(3.0));
  CHECK(mesh::edge_loops(surface) == 0);
  CHECK(mesh::count_parts(mesh::face_parts(surface)) == 1);
  CHECK(mesh::count_parts(mesh::cell_parts(mesh)) == 1);
  CHECK(mesh::crowded_faces(mesh).empty());
}

TEST_CASE("cubes on doubled nodes do not hang together", "[unit][mesh]") {
  const mesh::Mesh mesh = cubes(3, true);
  CHECK(mesh::count_parts(mesh::cell_parts(mesh)) == 2);
  CHECK(mesh::count_parts(mesh::face_parts(mesh::boundary(mesh))) == 2);
}

TEST_CASE("a cell given three times crowds its faces", "[unit][mesh]") {
  mesh::Mesh mesh = cubes(1);
  const std::vector<int> cell = mesh.cells;
  for (int i = 0; i < 2; ++i)
    mesh.cells.insert(mesh.cells.end(), cell.begin(), cell.end());
  CHECK(mesh::crowded_faces(mesh).size() == 6);
}

TEST_CASE("a disc has one edge and a ring two", "[unit][mesh]") {
  for (const auto kind : {mesh::CellKind::hexahedron, mesh::CellKind::tetrahedron}) {
    const mesh::Mesh mesh = test::coarse_mesh(kind);
    CHECK(mesh::edge_loops(mesh.endo) == 1);
    CHECK(mesh::edge_loops(mesh.base) == 2);
  }
}
