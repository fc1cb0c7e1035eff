#include "lv/mesh/undeformed_wall.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/cell.hpp"

#include "support/block_mesh.hpp"
#include "support/cell_kinds.hpp"
#include <catch2/catch.hpp>

namespace {

using namespace lv;
using mesh::CellKind;
using mesh::Mesh;

/// The point of a linear cell at a place of the reference element.
mesh::UndeformedPoint undeformed_point(const Mesh& mesh, int cell,
                                       const std::array<double, 3>& xi) {
  const mesh::UndeformedWall wall(mesh);
  if (mesh.kind == CellKind::hexahedron) {
    const auto shapes = mesh::hexahedron_shapes(xi);
    return wall.at(mesh::point_of(mesh, cell, shapes));
  }
  const auto shapes = mesh::simplex_shapes<1, 3>(xi);
  return wall.at(mesh::point_of(mesh, cell, shapes));
}

}  // namespace

TEST_CASE("the directions at a point are those of the depth's gradient and the rule",
          "[unit][mesh]") {
  for (const CellKind kind : test::kinds) {
    Mesh mesh = test::block_mesh(kind);
    mesh.fibres.rule = {0.4, 0.4, 0.3, 0.3};
    for (const int cell : {0, mesh.cell_count() / 2, mesh.cell_count() - 1}) {
      const mesh::UndeformedPoint p = undeformed_point(mesh, cell, {0.25, 0.25, 0.25});
      if (kind == CellKind::tetrahedron) {
        CHECK((p.X - mesh::cell_centre(mesh, cell)).norm() < 1e-12);
        CHECK(p.det == Approx(6.0 * mesh::cell_volume(mesh, cell)).epsilon(1e-12));
      }
      CHECK(p.det == Approx(p.dX_dxi.determinant()).epsilon(1e-14));
      CHECK((p.axes.radial - Vec3::UnitX()).norm() < 1e-12);  // t grows along x
      CHECK((p.frame - mesh::fibre_frame(mesh.fibres.rule, p.axes, p.t)).norm() < 1e-14);
      CHECK((mesh::UndeformedWall(mesh).frame_of_cell(cell) - p.frame).norm() < 1e-12);
    }
  }
}

TEST_CASE("the infarct's extent stays between 0 and 1 where quadratic shapes do not",
          "[unit][mesh]") {
  Mesh mesh = test::block_mesh(CellKind::hexahedron);
  const auto nodes = mesh.cell(0);
  for (const int node : nodes)
    mesh.infarct[node] = 1.0;
  const mesh::UndeformedWall wall(mesh);
  const auto s = mesh::hexahedron_shapes({0.5, 0.5, 0.5});
  for (const double beyond : {1.1, -0.1}) {  // as a sum of shapes that are negative somewhere
    auto phi = s.value;
    for (double& value : phi)
      value *= beyond;
    CHECK(wall.at({0, nodes, phi, {s.gradient.front().data(), 24}}).M ==
          (beyond > 0.0 ? 1.0 : 0.0));
  }
}

TEST_CASE("a collapsed element is named", "[unit][mesh]") {
  for (const CellKind kind : test::kinds) {
    Mesh mesh = test::block_mesh(kind);
    const auto cell = mesh.cell(5);
    const Vec3 there = mesh.nodes[cell[0]];
    for (const int node : cell)
      mesh.nodes[node] = there;
    CHECK_THROWS_AS(undeformed_point(mesh, 5, {0.25, 0.25, 0.25}), InputError);
    CHECK_THROWS_WITH(undeformed_point(mesh, 5, {0.25, 0.25, 0.25}),
                      Catch::Matchers::Contains("element 5 "));
  }
}
