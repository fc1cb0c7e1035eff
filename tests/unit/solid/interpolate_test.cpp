#include "lv/solid/interpolate.hpp"

#include "lv/base/check.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include "support/block_mesh.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;

Vec3 linear(const Vec3& x) {
  return {1.0 + 2.0 * x.x() - x.z(), 0.5 * x.y() + x.x(), -3.0 * x.z()};
}

Vec3 quadratic(const Vec3& x) {
  return {x.x() * x.y(), x.z() * x.z(), linear(x).x()};
}

template <class Field>
std::vector<Vec3> at_nodes(const mesh::Mesh& mesh, const Field& field) {
  std::vector<Vec3> values;
  for (const Vec3& X : mesh.nodes)
    values.push_back(field(X));
  return values;
}

/// Points inside the mesh that are no nodes.
std::vector<Vec3> between_nodes(const mesh::Mesh& mesh) {
  std::vector<Vec3> points;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const auto cell = mesh.cell(c);
    points.push_back(0.7 * mesh.nodes[cell[0]] + 0.2 * mesh.nodes[cell[1]] +
                     0.1 * mesh.nodes[cell[3]]);
  }
  return points;
}

template <class Field>
double largest_error(const mesh::Mesh& mesh, const Field& field, const std::vector<Vec3>& points) {
  const std::vector<Vec3> found = solid::interpolate(mesh, at_nodes(mesh, field), points);
  double error = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    error = std::max(error, (found[i] - field(points[i])).norm());
  return error;
}

}  // namespace

TEST_CASE("linear fields are interpolated exactly by every kind of element", "[solid]") {
  for (const auto kind : {mesh::CellKind::hexahedron, mesh::CellKind::tetrahedron}) {
    const mesh::Mesh block = test::block_mesh(kind, 3);
    CHECK(largest_error(block, linear, between_nodes(block)) < 1e-9);
    const mesh::Mesh fine = mesh::refine(block);
    CHECK(largest_error(fine, linear, between_nodes(fine)) < 1e-9);
  }
}

TEST_CASE("quadratic elements interpolate quadratic fields exactly", "[solid]") {
  for (const auto kind : {mesh::CellKind::hexahedron, mesh::CellKind::tetrahedron}) {
    const mesh::Mesh fine = mesh::refine(test::block_mesh(kind, 2));
    CHECK(largest_error(fine, quadratic, between_nodes(fine)) < 1e-9);
  }
}

TEST_CASE("a finer mesh of a curved wall takes the coarse one's field", "[solid]") {
  const auto map = [e = geometry::Ellipsoid{}](double u, double theta, double t) {
    return e.point(u, theta, t);
  };
  const mesh::Mesh coarse = mesh::wall_mesh(map, {.edge_length = 4.0, .order = 2});
  const mesh::Mesh fine = mesh::wall_mesh(map, {.edge_length = 3.0});
  CHECK(largest_error(coarse, linear, fine.nodes) < 1e-8);
}

TEST_CASE("a point far from the mesh is refused", "[solid]") {
  const mesh::Mesh block = test::block_mesh(mesh::CellKind::hexahedron, 2);
  const Vec3 far = block.nodes.back() + Vec3(1e3, 0.0, 0.0);
  CHECK_THROWS_AS(solid::interpolate(block, block.nodes, std::vector<Vec3>{far}), RunError);
}
