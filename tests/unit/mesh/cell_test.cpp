#include "lv/mesh/cell.hpp"

#include "mesh_io/mesh_files.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using mesh::CellKind;
using mesh::Mesh;

Mesh single_cell(CellKind kind, std::vector<Vec3> nodes) {
  Mesh mesh;
  mesh.kind = kind;
  mesh.nodes = std::move(nodes);
  for (int i = 0; i < mesh::nodes_per_cell(kind); ++i)
    mesh.cells.push_back(i);
  return mesh;
}

Mesh brick(double x, double y, double z) {
  return single_cell(
      CellKind::hexahedron,
      {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}, {0, 0, z}, {x, 0, z}, {x, y, z}, {0, y, z}});
}

Mesh regular_tetrahedron() {
  return single_cell(CellKind::tetrahedron, {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}});
}

}  // namespace

TEST_CASE("cubes and regular tetrahedra have the best figures", "[unit][mesh]") {
  for (const Mesh& mesh : {brick(2, 2, 2), regular_tetrahedron()}) {
    CHECK(mesh::scaled_jacobian(mesh, 0) == Approx(1.0));
    CHECK(mesh::aspect_ratio(mesh, 0) == Approx(1.0));
  }
  CHECK(mesh::cell_volume(brick(2, 2, 2), 0) == Approx(8.0));
  CHECK(mesh::cell_volume(regular_tetrahedron(), 0) == Approx(8.0 / 3.0));
}

TEST_CASE("a brick's Jacobian is its volume and its aspect ratio that of its edges",
          "[unit][mesh]") {
  const Mesh mesh = brick(1, 2, 5);
  CHECK(mesh::smallest_jacobian(mesh, 0) == Approx(10.0));
  CHECK(mesh::cell_volume(mesh, 0) == Approx(10.0));
  CHECK(mesh::scaled_jacobian(mesh, 0) == Approx(1.0));
  CHECK(mesh::aspect_ratio(mesh, 0) == Approx(5.0));
  CHECK(mesh::cell_centre(mesh, 0).isApprox(Vec3(0.5, 1.0, 2.5)));
}

TEST_CASE("a sheared brick's scaled Jacobian is the cosine of the shear", "[unit][mesh]") {
  Mesh mesh = brick(1, 1, 1);
  for (Vec3& X : mesh.nodes)
    X.x() += std::tan(0.5) * X.z();
  CHECK(mesh::scaled_jacobian(mesh, 0) == Approx(std::cos(0.5)));
  CHECK(mesh::cell_volume(mesh, 0) == Approx(1.0));
}

TEST_CASE("a dented hexahedron is inverted at a corner and nowhere else", "[unit][mesh]") {
  Mesh mesh = brick(1, 1, 1);
  mesh.nodes[6] = {0.3, 0.3, 0.3};
  CHECK(mesh::smallest_jacobian(mesh, 0) < 0.0);
  CHECK(mesh::scaled_jacobian(mesh, 0) < 0.0);
  CHECK(mesh::cell_volume(mesh, 0) > 0.0);
}

TEST_CASE("inverted cells have negative figures and flat ones zero", "[unit][mesh]") {
  Mesh tetrahedron = regular_tetrahedron();
  std::swap(tetrahedron.cells[0], tetrahedron.cells[1]);
  CHECK(mesh::scaled_jacobian(tetrahedron, 0) == Approx(-1.0));
  CHECK(mesh::cell_volume(tetrahedron, 0) == Approx(-8.0 / 3.0));
  Mesh flat = brick(1, 1, 0);
  CHECK(mesh::smallest_jacobian(flat, 0) == 0.0);
  CHECK(mesh::scaled_jacobian(flat, 0) == 0.0);
}

TEST_CASE("faces of cells have normals out of the cell", "[unit][mesh]") {
  for (const Mesh& mesh : {brick(1, 2, 3), regular_tetrahedron()}) {
    const Vec3 centre = mesh::cell_centre(mesh, 0);
    for (const mesh::LocalFace& face : mesh::cell_faces(mesh.kind)) {
      const Vec3& X = mesh.nodes[face[0]];
      const Vec3 normal = (mesh.nodes[face[1]] - X).cross(mesh.nodes[face[2]] - X);
      CHECK(normal.dot(X - centre) > 0.0);
    }
  }
}
