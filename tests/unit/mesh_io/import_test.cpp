#include "lv/mesh_io/import.hpp"

#include "lv/mesh/quality.hpp"
#include "lv/mesh/surface.hpp"

#include "mesh_io/mesh_files.hpp"
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

namespace {

using namespace lv;
using mesh::CellKind;
using mesh::ImportParameters;
using mesh::Mesh;
using mesh_io::ImportedMesh;
using test::AbaqusTags;
using test::by_cells;
using test::by_geometry;
using test::import_text;
using test::kinds;
using test::VtkTags;

/// A mesh with an infarct field, so that round trips can lose it.
Mesh with_infarct(CellKind kind) {
  Mesh mesh = test::coarse_mesh(kind);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    mesh.infarct[i] = mesh.nodes[i].x() > 10.0 ? 1.0 : 0.25;
  return mesh;
}

void check_same(const Mesh& found, const Mesh& expected) {
  CHECK(found.kind == expected.kind);
  CHECK((found.cells == expected.cells));
  REQUIRE(found.nodes.size() == expected.nodes.size());
  double furthest = 0.0;
  for (std::size_t i = 0; i < found.nodes.size(); ++i)
    furthest = std::max(furthest, (found.nodes[i] - expected.nodes[i]).norm());
  CHECK(furthest < 1e-9);
  CHECK((test::sorted_keys(found.endo) == test::sorted_keys(expected.endo)));
  CHECK((test::sorted_keys(found.epi) == test::sorted_keys(expected.epi)));
  CHECK((test::sorted_keys(found.base) == test::sorted_keys(expected.base)));
  double enclosed = 0.0;
  for (const mesh::Surface* side : {&found.endo, &found.epi, &found.base})
    enclosed += mesh::signed_volume(found.nodes, *side, {1.0, 2.0, 3.0});
  CHECK(enclosed == Approx(mesh::quality(expected).wall_volume));  // normals point outwards
}

/// The ventricle somewhere else, pointing elsewhere.
Mesh moved(Mesh mesh, const Mat3& rotation, const Vec3& shift) {
  for (Vec3& X : mesh.nodes)
    X = rotation * X + shift;
  return mesh;
}

const Mat3 rotation = Eigen::AngleAxisd(2.2, Vec3(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
const Vec3 shift(120.0, -35.0, 410.0);

}  // namespace

TEST_CASE("ABAQUS meshes come back from every way to tag their sides", "[unit][mesh_io]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    for (const auto tags : {AbaqusTags::labelled_faces, AbaqusTags::node_sets, AbaqusTags::shells})
      check_same(import_text(".inp", test::abaqus_text(mesh, tags)).mesh, mesh);
    check_same(import_text(".inp", test::abaqus_text(mesh, AbaqusTags::none), by_geometry()).mesh,
               mesh);
  }
}

TEST_CASE("VTK meshes come back from every way to tag their sides, with the infarct",
          "[unit][mesh_io]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = with_infarct(kind);
    for (const auto& [ending, text] :
         {std::pair{".vtk", &test::vtk_text}, {".vtu", &test::vtu_text}}) {
      INFO(ending);
      for (const auto& [tags, parameters] : {std::pair{VtkTags::surface_cells, by_cells()},
                                             {VtkTags::point_arrays, ImportParameters{}},
                                             {VtkTags::none, by_geometry()}}) {
        const ImportedMesh imported = import_text(ending, text(mesh, tags), parameters);
        check_same(imported.mesh, mesh);
        CHECK((imported.mesh.infarct == mesh.infarct));
      }
    }
  }
}

TEST_CASE("Gmsh meshes come back by the names and numbers of their physical surfaces",
          "[unit][mesh_io]") {
  ImportParameters numbers;
  numbers.endo = "1";
  numbers.epi = "2";
  numbers.base = "3";
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    for (const std::string& text : {test::gmsh22_text(mesh), test::gmsh41(mesh)}) {
      check_same(import_text(".msh", text).mesh, mesh);
      check_same(import_text(".msh", text, numbers).mesh, mesh);
      check_same(import_text(".msh", text, by_geometry()).mesh, mesh);
    }
  }
}

TEST_CASE("a mesh in any place and unit comes to the model frame, which leads back",
          "[unit][mesh_io]") {
  const Mesh model = test::coarse_mesh(CellKind::tetrahedron);
  Mesh elsewhere = moved(model, rotation, shift);
  for (Vec3& X : elsewhere.nodes)
    X /= 10.0;
  for (const auto sides : {mesh::SideSource::tags, mesh::SideSource::geometry}) {
    ImportParameters parameters;
    parameters.unit = 10.0;
    parameters.sides = sides;
    const ImportedMesh imported =
        import_text(".inp", test::abaqus_text(elsewhere, AbaqusTags::node_sets), parameters);
    const Mat3& axes = imported.frame.axes;
    CHECK(axes.determinant() == Approx(1.0));
    CHECK((axes.transpose() * axes - Mat3::Identity()).norm() < 1e-12);
    CHECK((axes.col(2) - rotation.col(2)).norm() < 1e-9);
    CHECK((imported.frame.origin - shift).norm() < 1e-9);
    double lost = 0.0;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      lost = std::max(
          lost,
          (imported.frame.to_image(imported.mesh.nodes[i]) - 10.0 * elsewhere.nodes[i]).norm());
      CHECK(imported.mesh.nodes[i].z() == Approx(model.nodes[i].z()).margin(1e-9));
    }
    CHECK(lost < 1e-9);
    for (const int node : imported.mesh.base.nodes)
      REQUIRE(imported.mesh.nodes[node].z() == 0.0);
    CHECK(imported.mesh.transmural.size() == model.nodes.size());
  }
}

TEST_CASE("a ventricle upside down is turned, not mirrored", "[unit][mesh_io]") {
  const Mesh model = test::coarse_mesh(CellKind::hexahedron);
  const Mesh turned =
      moved(model, Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix(), {0, 0, 0});
  const ImportedMesh imported =
      import_text(".vtk", test::vtk_text(turned, VtkTags::none), by_geometry());
  CHECK(imported.frame.axes.determinant() == Approx(1.0));
  CHECK(imported.notes.empty());
  check_same(imported.mesh, moved(turned, imported.frame.axes.transpose(), {0, 0, 0}));
  for (const Vec3& X : imported.mesh.nodes)
    REQUIRE(X.z() <= 0.0);
}

TEST_CASE("a mesh whose cells are all inverted is mirrored and the user told", "[unit][mesh_io]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    Mesh inverted = mesh;
    const int n = mesh::nodes_per_cell(kind);
    for (int c = 0; c < mesh.cell_count(); ++c) {
      if (kind == CellKind::tetrahedron)
        std::swap(inverted.cells[n * c], inverted.cells[n * c + 1]);
      else
        for (int a = 0; a < 4; ++a)
          std::swap(inverted.cells[n * c + a], inverted.cells[n * c + 4 + a]);
    }
    const ImportedMesh imported =
        import_text(".inp", test::abaqus_text(inverted, AbaqusTags::node_sets));
    CHECK(mesh::quality(imported.mesh).wall_volume == Approx(mesh::quality(mesh).wall_volume));
    REQUIRE(imported.notes.size() == 1);
    CHECK(imported.notes[0].find("all elements were inverted") == 0);
  }
}

TEST_CASE("nodes that no cell uses are dropped and the file's numbers kept", "[unit][mesh_io]") {
  Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  const auto expected = mesh;
  mesh.nodes.insert(mesh.nodes.begin(), Vec3(1000.0, 0.0, 0.0));
  mesh.infarct.insert(mesh.infarct.begin(), 7.0);  // not checked either
  for (std::vector<int>* nodes : {&mesh.cells, &mesh.endo.nodes, &mesh.epi.nodes, &mesh.base.nodes})
    for (int& node : *nodes)
      ++node;
  const ImportedMesh abaqus =
      import_text(".inp", test::abaqus_text(mesh, AbaqusTags::labelled_faces));
  check_same(abaqus.mesh, expected);
  CHECK(abaqus.node_numbers.front() == 2);
  REQUIRE(abaqus.notes.size() == 1);
  CHECK(abaqus.notes[0] == "1 nodes that no element uses were dropped");
  check_same(import_text(".vtu", test::vtu_text(mesh, VtkTags::surface_cells), by_cells()).mesh,
             expected);
}

TEST_CASE("a second instance of an ABAQUS part is refused", "[unit][mesh_io]") {
  const std::string text =
      test::abaqus_text(test::coarse_mesh(CellKind::hexahedron), AbaqusTags::labelled_faces) +
      "*Assembly, name=A\n*Instance, name=Wall-1, part=WALL\n*End Instance\n"
      "*Instance, name=Wall-2, part=Wall\n90., 0., 0.\n*End Instance\n"
      "*End Assembly\n";
  CHECK_THROWS_WITH(import_text(".inp", text),
                    Catch::Contains("the part WALL has a second instance (the first at "));
}

TEST_CASE("ABAQUS sets by range, by name, by instance and in included files are understood",
          "[unit][mesh_io]") {
  const Mesh mesh = test::ellipsoid_mesh({}, 8.0);
  const int per_layer = static_cast<int>(mesh::surface_nodes(mesh.endo).size());
  const int last = static_cast<int>(mesh.nodes.size());
  std::string base;
  for (const int node : mesh::surface_nodes(mesh.base))
    base += "Wall-1." + std::to_string(node + 1) + ",\n";
  const test::TemporaryFile included(".inc", "*nset, nset = rim, instance=Wall-1\n" + base);
  const std::string assembly =
      "*Assembly, name=Assembly\n*Instance, name=Wall-1, part=WALL\n1., 2., 3.\n*End Instance\n"
      "*Node\n1, 0., 0., 0.\n*Nset, nset=reference\n1,\n"
      "*nset, nset=Inside, instance=Wall-1, generate\n1, " +
      std::to_string(per_layer) + "\n*nset, nset=Outside,\n instance=Wall-1, generate\n" +
      std::to_string(last - per_layer + 1) + ", " + std::to_string(last) +
      ", 1\n*Include, input=" + included.path() +
      "\n*nset, nset=opening, instance=Wall-1\nrim\n*End Assembly\n*Material, name=muscle\n";
  ImportParameters parameters;
  parameters.endo = "inside";
  parameters.epi = "OUTSIDE";
  parameters.base = "Opening";
  std::string text = test::abaqus_text(mesh, AbaqusTags::none) + assembly;
  for (const bool windows : {false, true}) {
    if (windows)
      for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.replace(at, 1, "\r\n");
    const ImportedMesh imported = import_text(".inp", text, parameters);
    check_same(imported.mesh, mesh);
    REQUIRE(imported.notes.size() == 1);
    CHECK(imported.notes[0].find("instance's place") != std::string::npos);
  }
}

TEST_CASE("a base that is plane within the tolerance is made plane", "[unit][mesh_io]") {
  Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  const int node = mesh.base.nodes[0];
  mesh.nodes[node].z() += 0.05;
  const ImportedMesh imported = import_text(".inp", test::abaqus_text(mesh, AbaqusTags::shells));
  for (const int n : imported.mesh.base.nodes)
    CHECK(imported.mesh.nodes[n].z() == 0.0);
  REQUIRE(imported.notes.size() == 1);
  CHECK(imported.notes[0].find("the base was made plane") == 0);
}
