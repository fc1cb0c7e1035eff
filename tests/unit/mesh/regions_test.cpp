#include "lv/mesh/regions.hpp"

#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/block_mesh.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <set>

namespace {

using namespace lv;
using mesh::Mesh;

/// A wall known by the centres of its cells, small tetrahedra around these points. Its cavity is 60
/// mm long and its epicardium 65 mm, so that slices are 10 mm apart.
Mesh cells_at(const std::vector<Vec3>& centres) {
  Mesh mesh;
  mesh.kind = mesh::CellKind::tetrahedron;
  mesh.nodes = {{0, 0, -60}, {0, 0, -65}};
  mesh.endo = {3, {0, 0, 0}};
  mesh.epi = {3, {1, 1, 1}};
  for (const Vec3& centre : centres) {
    for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)}) {
      mesh.cells.push_back(static_cast<int>(mesh.nodes.size()));
      mesh.nodes.push_back(centre + 1e-3 * corner);
    }
  }
  return mesh;
}

Vec3 at(double degrees, double z) {
  const double angle = degrees * M_PI / 180.0;
  return {25.0 * std::cos(angle), 25.0 * std::sin(angle), z};
}

/// Name of the sector of a point at this angle, anticlockwise from x seen from the base.
std::string sector_name_at(double degrees, double z, double septum_degrees) {
  const auto regions = mesh::divide(cells_at({at(degrees, z)}), {septum_degrees * M_PI / 180.0});
  return mesh::sector_name(regions.slice[0], regions.sector[0]);
}

std::string aha_name_at(double degrees, double z) {
  return mesh::aha_name(mesh::divide(cells_at({at(degrees, z)}), {}).aha[0]);
}

}  // namespace

TEST_CASE("a cell belongs to the slice plane nearest to its centre", "[unit][mesh]") {
  const std::vector<std::pair<double, int>> depths{{0.0, 1},   {-4.9, 1},  {-5.1, 2},  {-14.9, 2},
                                                   {-15.1, 3}, {-25.1, 4}, {-35.1, 5}, {-45.1, 6},
                                                   {-54.9, 6}, {-55.1, 7}, {-64.9, 7}};
  for (const auto& [z, slice] : depths) {
    INFO("z = " << z);
    CHECK(mesh::divide(cells_at({at(10, z)}), {}).slice[0] == slice);
  }
}

TEST_CASE("a given distance of the slice planes is kept, the last taking what is beyond",
          "[unit][mesh]") {
  const auto slice = [](double z) {
    return mesh::divide(cells_at({at(10, z)}), {0.0, 8.0}).slice[0];
  };
  CHECK(slice(-3.9) == 1);
  CHECK(slice(-4.1) == 2);
  CHECK(slice(-43.9) == 6);
  CHECK(slice(-44.1) == 7);
  CHECK(slice(-60.0) == 7);
}

TEST_CASE("six sectors lie around the septum as in a heart seen from the base", "[unit][mesh]") {
  // the septum at x: the anterior wall a quarter turn further, towards y
  for (const double septum : {0.0, 60.0, 200.0, -150.0}) {
    INFO("septum at " << septum);
    CHECK(sector_name_at(septum + 90, -10, septum) == "ant");
    CHECK(sector_name_at(septum + 61, -10, septum) == "ant");
    CHECK(sector_name_at(septum + 59, -10, septum) == "antsept");
    CHECK(sector_name_at(septum + 1, -10, septum) == "antsept");
    CHECK(sector_name_at(septum - 1, -10, septum) == "infsept");
    CHECK(sector_name_at(septum - 59, -10, septum) == "infsept");
    CHECK(sector_name_at(septum - 61, -10, septum) == "inf");
    CHECK(sector_name_at(septum - 119, -10, septum) == "inf");
    CHECK(sector_name_at(septum - 121, -10, septum) == "inflat");
    CHECK(sector_name_at(septum + 179, -10, septum) == "antlat");
    CHECK(sector_name_at(septum + 121, -10, septum) == "antlat");
    CHECK(sector_name_at(septum + 119, -10, septum) == "ant");
  }
}

TEST_CASE("the two apical slices have four sectors", "[unit][mesh]") {
  for (const double z : {-50.0, -60.0}) {
    CHECK(sector_name_at(90, z, 0.0) == "ant");
    CHECK(sector_name_at(46, z, 0.0) == "ant");
    CHECK(sector_name_at(44, z, 0.0) == "sept");
    CHECK(sector_name_at(-44, z, 0.0) == "sept");
    CHECK(sector_name_at(-46, z, 0.0) == "inf");
    CHECK(sector_name_at(-134, z, 0.0) == "inf");
    CHECK(sector_name_at(180, z, 0.0) == "lat");
    CHECK(sector_name_at(136, z, 0.0) == "lat");
  }
}

TEST_CASE("the 17 segments are where the American Heart Association puts them", "[unit][mesh]") {
  // Cerqueira et al., Circulation 105:539, 2002: thirds of the cavity, the apex beyond it
  CHECK(aha_name_at(90, -19) == "basal anterior");
  CHECK(aha_name_at(30, -19) == "basal anteroseptal");
  CHECK(aha_name_at(-30, -1) == "basal inferoseptal");
  CHECK(aha_name_at(-90, -1) == "basal inferior");
  CHECK(aha_name_at(-150, -1) == "basal inferolateral");
  CHECK(aha_name_at(150, -1) == "basal anterolateral");
  CHECK(aha_name_at(90, -21) == "mid anterior");
  CHECK(aha_name_at(30, -39) == "mid anteroseptal");
  CHECK(aha_name_at(150, -39) == "mid anterolateral");
  CHECK(aha_name_at(90, -41) == "apical anterior");
  CHECK(aha_name_at(0, -59) == "apical septal");
  CHECK(aha_name_at(-90, -59) == "apical inferior");
  CHECK(aha_name_at(180, -59) == "apical lateral");
  CHECK(aha_name_at(33, -61) == "apex");
}

TEST_CASE("segments have the Association's numbers", "[unit][mesh]") {
  const std::vector<std::pair<int, std::string>> numbers{
      {1, "basal anterior"},      {2, "basal anteroseptal"},
      {6, "basal anterolateral"}, {7, "mid anterior"},
      {10, "mid inferior"},       {12, "mid anterolateral"},
      {13, "apical anterior"},    {14, "apical septal"},
      {16, "apical lateral"},     {17, "apex"}};
  for (const auto& [number, name] : numbers)
    CHECK(mesh::aha_name(number) == name);
}

TEST_CASE("every region of a ventricle has cells, and every cell one of each kind",
          "[unit][mesh]") {
  const Mesh mesh = test::ellipsoid_mesh({}, 4.0, 2);
  const auto regions = mesh::divide(mesh, {0.3});
  REQUIRE(static_cast<int>(regions.slice.size()) == mesh.cell_count());
  REQUIRE(static_cast<int>(regions.sector.size()) == mesh.cell_count());
  REQUIRE(static_cast<int>(regions.aha.size()) == mesh.cell_count());
  std::set<std::pair<int, int>> sectors;
  for (int c = 0; c < mesh.cell_count(); ++c)
    sectors.insert({regions.slice[c], regions.sector[c]});
  CHECK(sectors.size() == 5 * 6 + 2 * 4);
  for (const auto& [slice, sector] : sectors) {
    CHECK(slice >= 1);
    CHECK(slice <= 7);
    CHECK(sector >= 1);
    CHECK(sector <= mesh::sectors_of_slice(slice));
  }
  CHECK(std::set<int>(regions.aha.begin(), regions.aha.end()).size() == 17);
}

TEST_CASE("the division turns with the septum", "[unit][mesh]") {
  const Mesh mesh = test::coarse_mesh(mesh::CellKind::hexahedron);
  const auto before = mesh::divide(mesh, {0.3});
  Mesh turned = mesh;
  turned.nodes = test::moved(mesh.nodes, Eigen::AngleAxisd(1.9, Vec3::UnitZ()).toRotationMatrix());
  const auto after = mesh::divide(turned, {0.3 + 1.9});
  CHECK(after.slice == before.slice);
  CHECK(after.sector == before.sector);
  CHECK(after.aha == before.aha);
}

TEST_CASE("sectors are counted about the cavity's centre in their slice", "[unit][mesh]") {
  const Mesh upright = test::coarse_mesh(mesh::CellKind::hexahedron);
  Mesh bent = upright;  // the apex half leans to one side, as those of real ventricles do
  for (Vec3& x : bent.nodes)
    x += Vec3(0.15 * x.z(), -0.1 * x.z(), 0.0);
  const mesh::Regions expected = mesh::divide(upright, {});
  const mesh::Regions regions = mesh::divide(bent, {});
  int moved = 0;
  for (int c = 0; c < upright.cell_count(); ++c)
    moved += regions.sector[c] != expected.sector[c] ? 1 : 0;
  CHECK(moved < upright.cell_count() / 20);  // cells at a border may change sides
}

TEST_CASE("factors of segments are means of the cells around each node", "[unit][mesh]") {
  Mesh mesh = cells_at({at(0, -5), at(90, -5)});
  mesh.nodes[mesh.cells[4]] = mesh.nodes[mesh.cells[0]];
  mesh.cells[4] = mesh.cells[0];  // both cells have it
  mesh::SegmentFactors factors = mesh::even_segments();
  factors[2] = 0.4;
  CHECK(mesh::at_nodes(mesh, factors).empty());  // without segments
  mesh.segment = {3, 17};
  CHECK(mesh::at_nodes(mesh, mesh::even_segments()).empty());
  const auto nodal = mesh::at_nodes(mesh, factors);
  CHECK(nodal[mesh.cells[0]] == Approx(0.7));
  CHECK(nodal[mesh.cells[1]] == Approx(0.4));
  CHECK(nodal[mesh.cells[5]] == Approx(1.0));
}

TEST_CASE("the septum is what of the epicardium lies between the insertions", "[unit][mesh]") {
  for (const int order : {1, 2}) {
    Mesh wall =
        mesh::wall_mesh([e = geometry::Ellipsoid{}](double u, double theta,
                                                    double t) { return e.point(u, theta, t); },
                        {.edge_length = 5.0, .layers = 2, .order = order});
    CHECK(mesh::septum(wall).nodes.empty());  // without segments
    wall.segment = mesh::divide(wall, {}).aha;
    const mesh::Surface found = mesh::septum(wall);
    CHECK(mesh::area(wall.nodes, found) ==
          Approx(0.31 * mesh::area(wall.nodes, wall.epi)).epsilon(0.1));
    for (int f = 0; f < found.size(); ++f) {
      const Vec3 x = mesh::face_centre(wall.nodes, found.face(f));
      CHECK(std::abs(std::atan2(x.y(), x.x())) < 1.3);  // 60 degrees, and half of a side
    }
  }
}
