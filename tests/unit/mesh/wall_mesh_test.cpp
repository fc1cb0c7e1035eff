#include "lv/mesh/wall_mesh.hpp"

#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/solid/endocardial_surface.hpp"

#include "mesh_io/mesh_files.hpp"
#include <catch2/catch.hpp>

#include <algorithm>

namespace {

using namespace lv;
using geometry::Ellipsoid;

/// The healthy default, a long thin ventricle, a dilated thin-walled one, a hypertrophied one, a
/// half ellipsoid and a spherical shell.
const std::vector<Ellipsoid> ventricles{{},
                                        {15.0, 70.0, 22.0, 76.0, 25.0},
                                        {32.0, 75.0, 38.0, 80.0, 20.0},
                                        {14.0, 45.0, 32.0, 60.0, 12.0},
                                        {20.0, 50.0, 30.0, 60.0, 0.0},
                                        {30.0, 30.0, 40.0, 40.0, 15.0}};
const std::vector<double> edge_lengths{8.0, 5.0, 3.0};

template <class Check>
void for_every_mesh(Check&& check) {
  for (const Ellipsoid& v : ventricles) {
    for (const double edge : edge_lengths) {
      INFO("endocardium " << v.endo_radius << " x " << v.endo_length << " mm, edges of " << edge
                          << " mm");
      check(v, edge, test::ellipsoid_mesh(v, edge));
    }
  }
}

std::vector<mesh::FaceKey> keys(const std::vector<const mesh::Surface*>& surfaces) {
  std::vector<mesh::FaceKey> keys;
  for (const mesh::Surface* surface : surfaces)
    for (int f = 0; f < surface->size(); ++f)
      keys.push_back(mesh::face_key(surface->face(f)));
  std::sort(keys.begin(), keys.end());
  return keys;
}

}  // namespace

TEST_CASE("elements become smaller towards the apex and the endocardium", "[unit][mesh]") {
  const Ellipsoid v;
  const auto wall = [&](double u, double theta, double t) { return v.point(u, theta, t); };
  const mesh::Mesh even = mesh::wall_mesh(wall, {.edge_length = 3.0});
  const mesh::Mesh graded =
      mesh::wall_mesh(wall, {.edge_length = 3.0, .apex = 0.3, .endocardium = 0.5});
  REQUIRE(graded.cells == even.cells);
  // along the axis: the depths of the second layer's nodes; along the endocardium: the distance of
  // the apex from the nodes around it
  const auto second_depth = [](const mesh::Mesh& m) {
    double least = 1.0;
    for (const double t : m.transmural)
      if (t > 1e-9)
        least = std::min(least, t);
    return least;
  };
  const auto apical_edge = [](const mesh::Mesh& m) {
    double least = 1e9;
    for (const Vec3& X : m.nodes)
      if (X.z() < -79.0 && X.z() > -80.5 && X.head<2>().norm() > 1e-6)
        least = std::min(least, X.head<2>().norm());
    return least;
  };
  const double layers = std::round(1.0 / second_depth(even));
  CHECK(second_depth(graded) == Approx((0.5 + 0.5 / layers) / layers));
  CHECK(apical_edge(graded) < 0.4 * apical_edge(even));
  const mesh::Quality quality = mesh::quality(graded);
  CHECK(quality.scaled_jacobian.min > 0.3);
  CHECK(quality.wall_volume == Approx(mesh::quality(even).wall_volume).epsilon(0.01));
}

TEST_CASE("wall meshes have well-shaped cells", "[unit][mesh]") {
  for_every_mesh([](const Ellipsoid&, double, const mesh::Mesh& mesh) {
    const mesh::Quality quality = mesh::quality(mesh);
    CHECK(quality.scaled_jacobian.min > 0.3);
    CHECK(quality.edge_length.min > 0.0);
    double smallest = quality.wall_volume;
    for (int c = 0; c < mesh.cell_count(); ++c)
      smallest = std::min(smallest, mesh::smallest_jacobian(mesh, c));
    CHECK(smallest > 0.0);
  });
}

TEST_CASE("the sides of a wall mesh close it with outward normals", "[unit][mesh]") {
  for_every_mesh([](const Ellipsoid&, double, const mesh::Mesh& mesh) {
    const mesh::Surface all = mesh::boundary(mesh);
    CHECK((keys({&mesh.endo, &mesh.epi, &mesh.base}) == keys({&all})));
    // the divergence theorem holds only if every normal points out of the wall
    const Vec3 anywhere(3.0, -4.0, 5.0);
    double enclosed = 0.0;
    for (const mesh::Surface* side : {&mesh.endo, &mesh.epi, &mesh.base})
      enclosed += mesh::signed_volume(mesh.nodes, *side, anywhere);
    CHECK(enclosed == Approx(mesh::quality(mesh).wall_volume).epsilon(1e-10));
    CHECK(mesh::edge_loops(mesh.endo) == 1);
    CHECK(mesh::edge_loops(mesh.epi) == 1);
    CHECK(mesh::edge_loops(mesh.base) == 2);
    CHECK(mesh::count_parts(mesh::cell_parts(mesh)) == 1);
  });
}

TEST_CASE("wall meshes have the ellipsoids' volumes", "[unit][mesh]") {
  for_every_mesh([](const Ellipsoid& v, double edge, const mesh::Mesh& mesh) {
    // Chords of length h cut h^2/8R off a curve of radius R on both sides of a radius: a share of
    // about h^2/4R^2 of the volume; twice that is allowed.
    const auto share = [&](double radius) { return 0.5 * edge * edge / (radius * radius); };
    const double cavity = v.enclosed_volume(0.0);
    const double whole = v.enclosed_volume(1.0);
    CHECK(solid::EndocardialSurface(mesh).volume(mesh.nodes) ==
          Approx(cavity).epsilon(share(v.endo_radius)));
    const double margin = share(v.endo_radius) * cavity + share(v.epi_radius) * whole;
    CHECK(mesh::quality(mesh).wall_volume == Approx(whole - cavity).margin(margin));
  });
}

TEST_CASE("wall volumes converge to the ellipsoids' with the square of the edge length",
          "[unit][mesh]") {
  const Ellipsoid v;
  const double exact = v.enclosed_volume(0.0);
  const auto error = [&](double edge) {
    const mesh::Mesh mesh = test::ellipsoid_mesh(v, edge, 1);
    return std::abs(solid::EndocardialSurface(mesh).volume(mesh.nodes) - exact);
  };
  const double ratio = error(6.0) / error(2.0);
  CHECK(ratio > 6.0);  // 9 if the counts of elements followed the edge length exactly
  CHECK(ratio < 13.0);
}

TEST_CASE("wall meshes have nodes on the axis at the apex and a base in z = 0", "[unit][mesh]") {
  for_every_mesh([](const Ellipsoid& v, double, const mesh::Mesh& mesh) {
    for (const auto& [surface, length] :
         {std::pair{&mesh.endo, v.endo_length}, {&mesh.epi, v.epi_length}}) {
      const auto nodes = mesh::surface_nodes(*surface);
      const int lowest = *std::min_element(nodes.begin(), nodes.end(), [&](int a, int b) {
        return mesh.nodes[a].z() < mesh.nodes[b].z();
      });
      CHECK((mesh.nodes[lowest] - Vec3(0.0, 0.0, -v.base_height - length)).norm() < 1e-9);
    }
    for (const int node : mesh.base.nodes)
      REQUIRE(mesh.nodes[node].z() == 0.0);
    for (const Vec3& X : mesh.nodes)
      REQUIRE(X.z() <= 0.0);
  });
}

TEST_CASE("the transmural coordinate of a wall mesh is 0 inside and 1 outside", "[unit][mesh]") {
  for_every_mesh([](const Ellipsoid&, double, const mesh::Mesh& mesh) {
    for (const int node : mesh.endo.nodes)
      REQUIRE(mesh.transmural[node] == 0.0);
    for (const int node : mesh.epi.nodes)
      REQUIRE(mesh.transmural[node] == 1.0);
  });
}
