#include "lv/mesh/quality.hpp"

#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include "mesh_io/mesh_files.hpp"
#include <catch2/catch.hpp>

#include <numeric>

using namespace lv;

TEST_CASE("quality names the worst cell and its place", "[unit][mesh]") {
  mesh::Mesh mesh = test::coarse_mesh(mesh::CellKind::hexahedron);
  const int spoilt = mesh.cell_count() / 2;
  const auto cell = mesh.cell(spoilt);
  Vec3 centre = Vec3::Zero();
  for (const int node : cell)
    centre += mesh.nodes[node] / 8.0;
  // this corner only, not its neighbours' corners: the cell gets a node of its own
  mesh.nodes.push_back(0.9 * centre + 0.1 * mesh.nodes[cell[0]]);
  mesh.transmural.push_back(0.5);
  mesh.cells[8 * spoilt] = static_cast<int>(mesh.nodes.size()) - 1;
  const mesh::Quality quality = mesh::quality(mesh);
  CHECK(quality.worst_cell == spoilt);
  CHECK((quality.worst_place - centre).norm() < 2.0);
}

TEST_CASE("quality counts and measures the whole wall", "[unit][mesh]") {
  for (const auto kind : {mesh::CellKind::hexahedron, mesh::CellKind::tetrahedron}) {
    const mesh::Mesh mesh = test::coarse_mesh(kind);
    const mesh::Quality q = mesh::quality(mesh);
    CHECK(q.cells == mesh.cell_count());
    CHECK(q.nodes == static_cast<int>(mesh.nodes.size()));
    CHECK(q.wall_volume / 1000.0 == Approx(114.24).epsilon(0.05));  // faceted by 8 mm
    CHECK(q.endo_area < q.epi_area);
    const double base_area = 3.14159 * (30.0 * 30.0 * (1.0 - 400.0 / (69.0 * 69.0)) -
                                        19.5 * 19.5 * (1.0 - 400.0 / (60.0 * 60.0)));
    CHECK(q.base_area == Approx(base_area).epsilon(0.05));
    CHECK(q.scaled_jacobian.min <= q.scaled_jacobian.mean);
    CHECK(q.edge_length.min <= q.edge_length.mean);
    CHECK(q.edge_length.mean <= q.edge_length.max);
    const auto& counts = q.scaled_jacobians.counts;
    CHECK(std::accumulate(counts.begin(), counts.end(), 0) == q.cells);
  }
}

TEST_CASE("a wall of few quadratic elements has the volume of its curved shape", "[unit][mesh]") {
  const geometry::Ellipsoid ellipsoid;
  const auto wall = [&](double u, double theta, double t) { return ellipsoid.point(u, theta, t); };
  for (const double edge_length : {14.0, 16.0, 18.0}) {
    const mesh::Mesh mesh = mesh::wall_mesh(
        wall, {.edge_length = 0.5 * edge_length, .order = 2, .apex = 0.3, .endocardium = 0.5});
    CHECK(mesh::quality(mesh).wall_volume / 1000.0 == Approx(114.24).epsilon(2e-3));
  }
}

TEST_CASE("the table of figures has a line and a unit for each", "[unit][mesh]") {
  const auto rows = mesh::table(mesh::quality(test::coarse_mesh(mesh::CellKind::hexahedron)));
  const auto row = [&](const std::string& quantity) {
    for (const mesh::QualityRow& r : rows)
      if (r.quantity == quantity)
        return r;
    return mesh::QualityRow{"", -1.0, ""};
  };
  CHECK(row("wall volume").unit == "ml");
  CHECK(row("wall volume").value == Approx(114.24).epsilon(0.05));
  CHECK(row("mean edge length").unit == "mm");
  CHECK(row("cells with scaled Jacobian 0.9 to 1.0").value > 0.0);
  CHECK(row("z of worst cell").value <= 0.0);
  for (const mesh::QualityRow& r : rows)
    CHECK(r.quantity.find(',') == std::string::npos);  // it would be two fields of quality.csv
}
