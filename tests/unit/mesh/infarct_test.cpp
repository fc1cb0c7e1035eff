#include "lv/mesh/infarct.hpp"

#include "lv/analysis/wall_fields.hpp"
#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/units.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/refine.hpp"
#include "lv/mesh/regions.hpp"
#include "lv/mesh/split.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh_io/closed_surface.hpp"
#include "lv/mesh_io/import.hpp"
#include "lv/mesh_io/label_volume.hpp"
#include "lv/report/fields_vtk.hpp"

#include "mesh_io/mesh_files.hpp"
#include "support/block_mesh.hpp"
#include "support/cell_kinds.hpp"
#include "support/temporary_folder.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace lv;
using mesh::CellKind;
using mesh::DescribedInfarct;
using mesh::Infarcted;
using mesh::Mesh;
using test::kinds;
using units::degree;

double volume(const Mesh& mesh, const Infarcted& infarcted) {
  double sum = 0.0;
  for (int c = 0; c < mesh.cell_count(); ++c)
    sum += infarcted[c] ? mesh::cell_volume(mesh, c) : 0.0;
  return sum;
}

const Mesh& ventricle() {
  static const Mesh mesh = test::ellipsoid_mesh({}, 2.5, 6);
  return mesh;
}

Infarcted as_described(const Mesh& mesh, const DescribedInfarct& infarct,
                       const mesh::RegionParameters& regions) {
  return mesh::infarcted_where(mesh, mesh::described_region(mesh, infarct, regions));
}

/// Of the volume, by parts of elements.
double described_fraction(const DescribedInfarct& infarct) {
  const auto part =
      mesh::infarcted_part(ventricle(), mesh::described_region(ventricle(), infarct, {}));
  const auto volumes = mesh::infarct_volumes(ventricle(), part);
  return volumes.infarct / volumes.wall;
}

/// Sets the extent of an infarct; returns the infarcted parts of the elements.
std::vector<double> mark(Mesh& mesh, const mesh::Region& region, double border) {
  mesh.infarct = mesh::infarct_field(mesh, mesh::infarcted_where(mesh, region), border);
  return mesh::infarcted_part(mesh, region);
}

/// The whole wall.
DescribedInfarct everything() {
  return {.width = 360.0 * degree, .bottom = 0.0, .top = 1.0, .apex = 0.0};
}

/// The skin of the flagged cells as triangles.
std::vector<std::array<Vec3, 3>> skin(const Mesh& mesh, const Infarcted& infarcted) {
  Mesh part;
  part.kind = mesh.kind;
  part.nodes = mesh.nodes;
  for (int c = 0; c < mesh.cell_count(); ++c)
    if (infarcted[c])
      part.cells.insert(part.cells.end(), mesh.cell(c).begin(), mesh.cell(c).end());
  const mesh::Surface surface = mesh::boundary(part);
  std::vector<std::array<Vec3, 3>> triangles;
  for (int f = 0; f < surface.size(); ++f)
    mesh::for_triangles(surface.face(f), [&](int a, int b, int c) {
      triangles.push_back({mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]});
    });
  return triangles;
}

std::string stl_text(const std::vector<std::array<Vec3, 3>>& triangles) {
  std::string text = "solid scar\n";
  for (const auto& triangle : triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const Vec3& x : triangle)
      text += fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", x.x(), x.y(), x.z());
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid scar\n";
}

/// The unit cube's corners and faces as the bodies of PLY and legacy VTK files.
constexpr const char* cube_corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
constexpr const char* cube_faces =
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

std::string ply_cube() {
  return fmt::format(
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n{}{}",
      cube_corners, cube_faces);
}

std::string vtk_cube() {
  return fmt::format(
      "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET POLYDATA\nPOINTS 8 float\n{}POLYGONS 6 "
      "30\n{}",
      cube_corners, cube_faces);
}

/// A ball's labels, 7 inside and 0 outside, on n^3 voxels; at points or in cells.
std::string ball_image(const Vec3& centre, double radius, double spacing, int n, bool in_cells) {
  std::string values;
  const double shift = in_cells ? 0.5 : 0.0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vec3 x = spacing * Vec3(i + shift, j + shift, k + shift);
        values += (x - centre).norm() < radius ? "7 " : "0 ";
      }
  const int points = in_cells ? n + 1 : n;
  return fmt::format(
      "# vtk DataFile Version 3.0\nscar\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS {} {} {}\n"
      "ORIGIN 0 0 0\nSPACING {} {} {}\n{} {}\nSCALARS tissue int 1\nLOOKUP_TABLE default\n{}\n",
      points, points, points, spacing, spacing, spacing, in_cells ? "CELL_DATA" : "POINT_DATA",
      n * n * n, values);
}

template <class Work>
std::string message(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("M falls linearly from the infarct over the border zone along a ray", "[unit][mesh]") {
  for (const auto kind : kinds) {
    const Mesh mesh = test::cubes(kind, 12);
    const auto infarcted =
        mesh::infarcted_where(mesh, [](const Vec3& X, double) { return X.x() < 6.0; });
    const auto M = mesh::infarct_field(mesh, infarcted, 10.0);
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      const double x = mesh.nodes[a].x();
      REQUIRE(M[a] == Approx(std::clamp(1.0 - (x - 6.0) / 10.0, 0.0, 1.0)).margin(1e-14));
    }
  }
}

TEST_CASE("the distance in M is that to the nearest point of the infarct, round its corners too",
          "[unit][mesh]") {
  // The infarct is the cube [8, 12]^3.
  for (const auto kind : kinds) {
    const Mesh mesh = test::cubes(kind, 12);
    const auto infarcted = mesh::infarcted_where(mesh, [](const Vec3& X, double) {
      return (X - Vec3::Constant(10.0)).cwiseAbs().maxCoeff() < 2.0;
    });
    const auto M = mesh::infarct_field(mesh, infarcted, 7.0);
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      const Vec3 beyond =
          ((mesh.nodes[a] - Vec3::Constant(10.0)).cwiseAbs().array() - 2.0).max(0.0);
      REQUIRE(M[a] == Approx(std::max(0.0, 1.0 - beyond.norm() / 7.0)).margin(1e-14));
    }
  }
}

TEST_CASE("volumes tell infarct, border zone and remote muscle apart", "[unit][mesh]") {
  for (const auto kind : kinds) {
    Mesh mesh = test::cubes(kind, 12);  // 24 mm wide, a plane of elements has 1152 mm^3
    const auto part = mark(
        mesh, [](const Vec3& X, double) { return X.x() < 6.0; }, 10.0);
    const auto volumes = mesh::infarct_volumes(mesh, part);
    CHECK(volumes.wall == Approx(12 * 1152.0));
    CHECK(volumes.infarct == Approx(3 * 1152.0));
    CHECK(volumes.border == Approx(5 * 1152.0));
  }
}

TEST_CASE("the infarct is what lies inside it, not the elements that its nodes enclose",
          "[unit][mesh]") {
  for (const auto kind : kinds) {
    Mesh mesh = test::cubes(kind, 12);
    const auto slab = [](const Vec3& X, double) { return X.x() < 6.5; };
    const auto part = mark(mesh, slab, 10.0);
    CHECK(mesh::infarct_volumes(mesh, part).infarct == Approx(6.5 * 576.0).epsilon(0.01));
    // one healthy cube, all of whose nodes belong to infarcted ones
    const auto hole = [](const Vec3& X, double) {
      return X.x() < 8.0 && (X - Vec3(3.0, 9.0, 9.0)).cwiseAbs().maxCoeff() > 1.0;
    };
    const auto holed = mesh::infarct_volumes(mesh, mark(mesh, hole, 10.0));
    CHECK(holed.infarct == Approx(8.0 * 576.0 - 8.0));
    CHECK(holed.border == Approx(5 * 1152.0 + 8.0));
  }
}

TEST_CASE("a described sector has its share of a round wall", "[unit][mesh]") {
  CHECK(described_fraction(everything()) == Approx(1.0));
  for (const double width : {40.0, 120.0, 250.0}) {
    DescribedInfarct infarct = everything();
    infarct.angle = 0.2;
    infarct.width = width * degree;
    // a sector ends up to half a quarter of an element of 6 degrees early or late on either side
    CHECK(described_fraction(infarct) == Approx(width / 360.0).margin(1.5 / 360.0));
  }
}

TEST_CASE("a described infarct reaches from the apex to its height", "[unit][mesh]") {
  const geometry::Ellipsoid ellipsoid;
  const double length = ellipsoid.epi_length + ellipsoid.base_height;
  // of the ellipsoid with these semi-axes, between its apex and z
  const auto cap = [&](double r, double l, double z) {
    const double s = std::max((z + ellipsoid.base_height) / l, -1.0);
    return std::numbers::pi * r * r * l * (s - s * s * s / 3.0 + 2.0 / 3.0);
  };
  const auto wall_below = [&](double height) {
    const double z = (height - 1.0) * length;
    return cap(ellipsoid.epi_radius, ellipsoid.epi_length, z) -
           cap(ellipsoid.endo_radius, ellipsoid.endo_length, z);
  };
  for (const double height : {0.25, 0.5, 0.8}) {
    DescribedInfarct top = everything();
    top.top = height;
    DescribedInfarct apex = everything();
    apex.width = 0.0;
    apex.apex = height;
    // half a quarter of an element, 0.3 mm of 89 mm
    const auto expected = Approx(wall_below(height) / wall_below(1.0)).margin(0.004);
    CHECK(described_fraction(top) == expected);
    CHECK(described_fraction(apex) == expected);
  }
}

TEST_CASE("a described infarct reaches through the wall as far as its transmurality",
          "[unit][mesh]") {
  const geometry::Ellipsoid e;
  for (const double t : {0.3, 0.5, 0.6, 0.8}) {  // of the six layers' ends only 0.5
    DescribedInfarct infarct = everything();
    infarct.transmurality = t;
    const double expected = (e.enclosed_volume(t) - e.enclosed_volume(0.0)) /
                            (e.enclosed_volume(1.0) - e.enclosed_volume(0.0));
    CHECK(described_fraction(infarct) == Approx(expected).margin(0.02));  // 1/48 of the thickness
  }
}

TEST_CASE("30 degrees from the septum towards the anterior wall is the antero-septal sector",
          "[unit][mesh]") {
  const mesh::RegionParameters regions{.septum_angle = 0.3};
  DescribedInfarct infarct = everything();
  infarct.angle = 30.0 * degree;
  infarct.width = 60.0 * degree;
  const auto infarcted = as_described(ventricle(), infarct, regions);
  const auto divided = mesh::divide(ventricle(), regions);
  int different = 0;
  for (int c = 0; c < ventricle().cell_count(); ++c)
    if (divided.slice[c] <= 5)
      different +=
          infarcted[c] != (mesh::sector_name(divided.slice[c], divided.sector[c]) == "antsept");
  CHECK(different == 0);
}

TEST_CASE("the skin of an infarct, read as a surface, holds the same elements", "[unit][mesh]") {
  for (const auto kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    const auto infarcted = as_described(mesh, {.transmurality = 0.6}, {});
    const test::TemporaryFile file(".stl", stl_text(skin(mesh, infarcted)));
    const auto surface = mesh_io::read_closed_surface(file.path(), 1.0);
    CHECK((mesh::infarcted_where(
               mesh, [&](const Vec3& X, double) { return surface.contains(X); }) == infarcted));
  }
}

TEST_CASE("surfaces come from STL, PLY and VTK files, in any unit and orientation",
          "[unit][mesh]") {
  std::vector<std::array<Vec3, 3>> inside_out = skin(test::cubes(CellKind::hexahedron, 1), {true});
  for (auto& triangle : inside_out) {
    std::swap(triangle[0], triangle[1]);
    for (Vec3& x : triangle)
      x *= 0.5;
  }
  for (const auto& [ending, text] :
       {std::pair{".ply", ply_cube()}, {".vtk", vtk_cube()}, {".stl", stl_text(inside_out)}}) {
    INFO(ending);
    const test::TemporaryFile file(ending, text);
    const auto cube = mesh_io::read_closed_surface(file.path(), 10.0);
    CHECK((cube.box().max() - Vec3::Constant(10.0)).norm() < 1e-12);
    CHECK(cube.contains({5.0, 5.0, 5.0}));  // in the planes of diagonals
    CHECK(cube.contains({0.01, 9.99, 3.0}));
    CHECK_FALSE(cube.contains({-0.01, 5.0, 5.0}));
    CHECK_FALSE(cube.contains({5.0, 10.01, 5.0}));
    CHECK_FALSE(cube.contains({500.0, 5.0, 5.0}));
  }
}

TEST_CASE("a surface with a hole or with a triangle turned over is refused", "[unit][mesh]") {
  auto triangles = skin(test::cubes(CellKind::hexahedron, 1), {true});
  const auto read = [&] {
    const test::TemporaryFile file(".stl", stl_text(triangles));
    return message([&] { static_cast<void>(mesh_io::read_closed_surface(file.path(), 1.0)); });
  };
  std::swap(triangles[3][0], triangles[3][1]);
  CHECK_THAT(read(), Catch::Contains("is not closed: 3 edges"));
  triangles.erase(triangles.begin() + 3);
  CHECK_THAT(read(), Catch::Contains("is not closed: 3 edges"));
  triangles.clear();
  CHECK_THAT(read(), Catch::Contains("holds no triangles"));
}

TEST_CASE("labels at points or in cells mean a ball to within half a voxel", "[unit][mesh]") {
  const Mesh mesh = test::cubes(CellKind::tetrahedron, 12);
  const Vec3 centre(11.0, 12.0, 13.0);
  const double radius = 7.3;
  const double spacing = 0.8;
  for (const bool in_cells : {false, true}) {
    const test::TemporaryFile file(".vtk", ball_image(centre, radius, spacing, 40, in_cells));
    const mesh_io::LabelVolume volume(file.path(), "", 1.0);
    CHECK((volume.labels() == std::vector<int>{0, 7}));
    int wrong = 0;
    int inside = 0;
    for (int c = 0; c < mesh.cell_count(); ++c) {
      const Vec3 X = mesh::cell_centre(mesh, c);
      const double depth = radius - (X - centre).norm();
      const bool scar = volume.has(X, {3, 7});
      inside += scar ? 1 : 0;
      if (std::abs(depth) > 0.5 * std::sqrt(3.0) * spacing)
        wrong += scar != (depth > 0.0) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(inside > 0);
    CHECK_FALSE(volume.has({-5.0, 12.0, 13.0}, {0, 7}));
  }
}

TEST_CASE("a labelled volume scaled by its unit keeps its labels in their places", "[unit][mesh]") {
  const test::TemporaryFile file(".vtk", ball_image({1.0, 1.0, 1.0}, 0.5, 0.1, 20, false));
  const mesh_io::LabelVolume volume(file.path(), "tissue", 10.0);  // the file is in cm
  CHECK(volume.has({10.0, 10.0, 10.0}, {7}));
  CHECK(volume.has({10.0, 14.0, 10.0}, {7}));
  CHECK_FALSE(volume.has({10.0, 16.0, 10.0}, {7}));
  CHECK_THAT(message([&] { mesh_io::LabelVolume(file.path(), "tisue", 1.0); }),
             Catch::Contains("has no array \"tisue\"; it has tissue. Did you mean \"tissue\"?"));
}

TEST_CASE("several numbers a voxel are no labels", "[unit][mesh]") {
  const test::TemporaryFile file(
      ".VTK",
      "# vtk DataFile Version 3.0\npair\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 1 1\n"
      "ORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 2\nSCALARS tissue int 2\nLOOKUP_TABLE default\n"
      "0 7 0 7\n");
  CHECK_THAT(message([&] { mesh_io::LabelVolume(file.path(), "", 1.0); }),
             Catch::Contains("array \"tissue\" has 2 numbers for each voxel"));
}

TEST_CASE("an imported mesh knows its set of infarcted elements", "[unit][mesh]") {
  for (const auto kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    const auto infarcted = as_described(mesh, {}, {});
    std::string numbers;
    for (int c = 0; c < mesh.cell_count(); ++c)
      numbers += infarcted[c] ? fmt::format("{},\n", c + 1) : "";
    std::string abaqus = test::abaqus_text(mesh, test::AbaqusTags::none);
    abaqus.insert(abaqus.rfind("*End Part"), "*Elset, elset=Scar\n" + numbers);
    const std::string vtk =
        test::vtk_text(mesh, test::VtkTags::none) +
        fmt::format("CELL_DATA {}\nSCALARS scar int 1\nLOOKUP_TABLE default\n{}\n",
                    mesh.cell_count(),
                    fmt::join(std::vector<int>(infarcted.begin(), infarcted.end()), " "));
    for (const auto& [ending, text] :
         {std::pair{".inp", abaqus}, {".vtk", vtk}, {".msh", test::gmsh22_text(mesh, infarcted)}}) {
      INFO(ending);
      const test::TemporaryFile file(ending, text);
      mesh::ImportParameters parameters;
      parameters.file = file.path();
      parameters.sides = mesh::SideSource::geometry;
      const mesh_io::ImportedMesh unasked = mesh_io::import_mesh(parameters);
      CHECK(unasked.infarcted.empty());
      REQUIRE(unasked.unread);
      CHECK(lower_case(unasked.unread->name) == "scar");
      CHECK_FALSE(unasked.unread->at_points);
      parameters.infarct_set = "scar";
      const mesh_io::ImportedMesh asked = mesh_io::import_mesh(parameters);
      CHECK((asked.infarcted == infarcted));
      CHECK_FALSE(asked.unread);
      parameters.infarct_set = "scarr";
      CHECK_THAT(message([&] { static_cast<void>(mesh_io::import_mesh(parameters)); }),
                 Catch::Contains("\"scarr\""));
    }
  }
}

TEST_CASE("the program's own mesh gives its infarct back, border zone and all", "[unit][mesh]") {
  Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  const auto infarcted = as_described(mesh, {}, {});
  mesh.infarct = mesh::infarct_field(mesh, infarcted, 10.0);
  const test::TemporaryFolder folder;
  mesh::ImportParameters parameters = test::by_geometry();
  parameters.file = (folder / "mesh.vtu").string();
  report::write_mesh(folder / "mesh.vtu", mesh, mesh::divide(mesh, {}),
                     analysis::FieldAnalysis(mesh, {}).at_rest());
  const mesh_io::ImportedMesh imported = mesh_io::import_mesh(parameters);
  CHECK_FALSE(imported.unread);
  REQUIRE(imported.mesh.infarct.size() == mesh.infarct.size());
  double largest = 0.0;
  for (std::size_t a = 0; a < mesh.infarct.size(); ++a)
    largest = std::max(largest, std::abs(imported.mesh.infarct[a] - mesh.infarct[a]));
  CHECK(largest < 1e-6);  // single precision
}

TEST_CASE("a cell array of M means the elements with one, and its border zone is made anew",
          "[unit][mesh]") {
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  const auto infarcted = as_described(mesh, {}, {});
  const auto with = [&](double beside) {
    std::vector<double> M(infarcted.begin(), infarcted.end());
    *std::find(M.begin(), M.end(), 0.0) = beside;
    return test::vtk_text(mesh, test::VtkTags::none) +
           fmt::format("CELL_DATA {}\nSCALARS M double 1\nLOOKUP_TABLE default\n{}\n",
                       mesh.cell_count(), fmt::join(M, " "));
  };
  mesh::ImportParameters parameters = test::by_geometry();
  parameters.infarct_set = "M";
  const mesh_io::ImportedMesh imported = test::import_text(".vtk", with(0.4), parameters);
  CHECK((imported.infarcted == infarcted));
  REQUIRE(imported.notes.size() == 1);
  CHECK_THAT(imported.notes[0], Catch::Contains("in 1 cells") && Catch::Contains("infarct.border"));
  CHECK_THAT(message([&] { static_cast<void>(test::import_text(".vtk", with(1.5), parameters)); }),
             Catch::Contains("is 1.5 at cell"));
}

TEST_CASE("a refined mesh keeps the infarcted region", "[unit][mesh]") {
  for (const auto kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    const auto infarcted = as_described(mesh, {}, {});
    const Mesh fine = mesh::refine(mesh);
    const auto fine_infarcted = mesh::refine_flags(infarcted);
    REQUIRE(static_cast<int>(fine_infarcted.size()) == fine.cell_count());
    CHECK(volume(fine, fine_infarcted) == Approx(volume(mesh, infarcted)).epsilon(1e-12));
    const auto M = mesh::infarct_field(mesh, infarcted, 10.0);
    const auto fine_M = mesh::infarct_field(fine, fine_infarcted, 10.0);
    for (std::size_t a = 0; a < M.size(); ++a)  // faces of hexahedra are cut more finely
      REQUIRE(fine_M[a] == Approx(M[a]).margin(0.01));
  }
}

TEST_CASE("a dark core that the scar shuts off counts to it", "[unit][mesh]") {
  const DescribedInfarct scar{.width = 120.0 * degree, .bottom = 0.3, .top = 0.7, .apex = 0.0};
  DescribedInfarct core{.width = 40.0 * degree, .bottom = 0.4, .top = 0.6, .apex = 0.0};
  core.transmurality = 0.4;
  const Infarcted whole = as_described(ventricle(), scar, {});
  const Infarcted dark = as_described(ventricle(), core, {});
  Infarcted bright = whole;
  for (std::size_t c = 0; c < bright.size(); ++c)
    bright[c] = whole[c] && !dark[c];
  REQUIRE(bright != whole);
  CHECK(mesh::with_enclosed(ventricle(), bright) == whole);
  CHECK(mesh::with_enclosed(ventricle(), whole) == whole);
  core.transmurality = 1.0;  // open to the epicardium: not shut off
  const Infarcted through = as_described(ventricle(), core, {});
  for (std::size_t c = 0; c < bright.size(); ++c)
    bright[c] = whole[c] && !through[c];
  CHECK(mesh::with_enclosed(ventricle(), bright) == bright);
}

TEST_CASE("the infarct of the segments adds up, and its transmurality is that described",
          "[unit][mesh]") {
  DescribedInfarct scar{.width = 120.0 * degree, .bottom = 0.3, .top = 0.7, .apex = 0.0};
  scar.transmurality = 0.5;
  Mesh wall = ventricle();
  const auto part = mark(wall, mesh::described_region(wall, scar, {}), 10.0);
  const auto segments = mesh::infarct_by_segment(wall, part, mesh::divide(wall, {}), {});
  REQUIRE(segments.size() == 17);
  double sum = 0.0;
  double all = 0.0;
  for (const auto& s : segments) {
    sum += s.infarct;
    all += s.wall;
    if (s.infarct > 0.3 * s.wall)
      CHECK(s.transmurality == Approx(0.47).margin(0.1));  // the inner half is the smaller one
    CHECK((s.infarct > 0.0) == (s.transmurality > 0.0));
  }
  const auto volumes = mesh::infarct_volumes(wall, part);
  CHECK(sum == Approx(volumes.infarct));
  CHECK(all == Approx(volumes.wall));
}

TEST_CASE("an infarct through the wall is transmural up to its edges, on any mesh", "[mesh]") {
  const DescribedInfarct scar{
      .angle = 30.0 * degree, .width = 100.0 * degree, .top = 0.8, .apex = 0.3};
  for (const double edge : {7.0, 3.5}) {
    INFO(edge);
    Mesh wall =
        mesh::wall_mesh([e = geometry::Ellipsoid{}](double u, double theta,
                                                    double t) { return e.point(u, theta, t); },
                        {.edge_length = edge, .layers = edge > 5.0 ? 2 : 4});
    const auto part = mark(wall, mesh::described_region(wall, scar, {}), 10.0);
    for (const auto& s : mesh::infarct_by_segment(wall, part, mesh::divide(wall, {}), {})) {
      INFO(s.segment);
      if (s.infarct > 0.1 * s.wall)
        CHECK(s.transmurality == Approx(1.0).margin(0.1));
    }
  }
}
