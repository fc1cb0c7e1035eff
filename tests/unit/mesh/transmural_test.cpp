#include "lv/mesh/transmural.hpp"

#include "lv/mesh/distance.hpp"

#include "mesh_io/mesh_files.hpp"
#include <catch2/catch.hpp>

#include <random>

namespace {

using namespace lv;

mesh::Surface triangles(std::vector<int> nodes) {
  return {3, std::move(nodes)};
}

}  // namespace

TEST_CASE("distances to a triangle are those to its face, edges and corners", "[unit][mesh]") {
  const std::vector<Vec3> nodes{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}};
  const mesh::SurfaceDistance distance(nodes, triangles({0, 1, 2}));
  CHECK(distance({1, 1, 2}) == Approx(2.0));
  CHECK(distance({1, 1, -2}) == Approx(2.0));
  CHECK(distance.signed_distance({1, 1, 2}) == Approx(2.0));
  CHECK(distance.signed_distance({1, 1, -2}) == Approx(-2.0));
  CHECK(distance({1, 1, 0}) == 0.0);
  CHECK(distance({1, -2, 0}) == Approx(2.0));
  CHECK(distance({1, -3, 4}) == Approx(5.0));
  CHECK(distance({3, 3, 0}) == Approx(1.5 * std::sqrt(2.0)));
  CHECK(distance({-3, -4, 0}) == Approx(5.0));
  CHECK(distance({7, 0, 3}) == Approx(5.0));
}

TEST_CASE("the distance to a surface is the least of those to its triangles", "[unit][mesh]") {
  const mesh::Mesh mesh = test::coarse_mesh(mesh::CellKind::tetrahedron);
  const mesh::SurfaceDistance whole(mesh.nodes, mesh.epi);
  std::vector<mesh::SurfaceDistance> single;
  for (int f = 0; f < mesh.epi.size(); ++f) {
    const auto face = mesh.epi.face(f);
    single.emplace_back(mesh.nodes, triangles({face.begin(), face.end()}));
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-80.0, 40.0);
  for (int i = 0; i < 50; ++i) {
    const Vec3 x(coordinate(random), coordinate(random), coordinate(random));
    double least = 1e9;
    for (const mesh::SurfaceDistance& distance : single)
      least = std::min(least, distance(x));
    CHECK(whole(x) == Approx(least));
  }
}

TEST_CASE("in a spherical shell t grows linearly with the radius", "[unit][mesh]") {
  const geometry::Ellipsoid shell{20.0, 20.0, 30.0, 30.0, 10.0};
  const double edge = 3.0;
  const mesh::Mesh mesh = test::ellipsoid_mesh(shell, edge, 5);
  const auto t = mesh::transmural_by_distance(mesh);
  // A chord of length h runs h^2/8R inside its sphere; faces here reach twice the edge length.
  const double tolerance = 4.0 * edge * edge / (8.0 * 20.0) / 10.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Vec3 from_centre = mesh.nodes[i] + Vec3(0.0, 0.0, 10.0);
    if (from_centre.z() <= 0.0)  // above, the nearest point of the epicardium is its edge
      CHECK(t[i] == Approx((from_centre.norm() - 20.0) / 10.0).margin(tolerance));
  }
}

TEST_CASE("t is exactly 0 and 1 on the sides of the wall and between them inside", "[unit][mesh]") {
  for (const auto kind : {mesh::CellKind::hexahedron, mesh::CellKind::tetrahedron}) {
    const mesh::Mesh mesh = test::coarse_mesh(kind);
    const auto t = mesh::transmural_by_distance(mesh);
    std::vector<bool> on_side(t.size(), false);
    for (const int node : mesh.endo.nodes) {
      CHECK(t[node] == 0.0);
      on_side[node] = true;
    }
    for (const int node : mesh.epi.nodes) {
      CHECK(t[node] == 1.0);
      on_side[node] = true;
    }
    for (std::size_t i = 0; i < t.size(); ++i)
      CHECK((on_side[i] || (t[i] > 0.0 && t[i] < 1.0)));
  }
}
