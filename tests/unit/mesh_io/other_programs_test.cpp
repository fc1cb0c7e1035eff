// What files of other programs hold beside plain elements: groups of single elements, elements of
// higher order, sides in files of their own, the space that coordinates are in.
#include "lv/base/check.hpp"
#include "lv/mesh/quality.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh_io/closed_surface.hpp"
#include "lv/mesh_io/import.hpp"
#include "lv/mesh_io/label_volume.hpp"

#include "mesh_io/mesh_files.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <map>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
using mesh::CellKind;
using mesh::ImportParameters;
using mesh::Mesh;
using mesh::Surface;
using mesh_io::ImportedMesh;
using test::AbaqusTags;
using test::by_geometry;
using test::import_text;
using test::kinds;
using test::replaced;
using test::VtkTags;

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void check_sides(const Mesh& found, const Mesh& expected) {
  CHECK((found.cells == expected.cells));
  CHECK((test::sorted_keys(found.endo) == test::sorted_keys(expected.endo)));
  CHECK((test::sorted_keys(found.epi) == test::sorted_keys(expected.epi)));
  CHECK((test::sorted_keys(found.base) == test::sorted_keys(expected.base)));
}

/// Every third cell.
std::vector<bool> some_cells(const Mesh& mesh) {
  std::vector<bool> some;
  for (int c = 0; c < mesh.cell_count(); ++c)
    some.push_back(c % 3 == 0);
  return some;
}

std::string joined(const std::vector<int>& nodes, int first, const char* separator) {
  std::vector<int> numbers;
  for (const int node : nodes)
    numbers.push_back(node + first);
  return fmt::format("{}", fmt::join(numbers, separator));
}

/// A legacy VTK file of quadratic cells, without sides.
std::string quadratic_vtk(const test::Quadratic& mesh, int type) {
  std::string text = fmt::format(
      "# vtk DataFile Version 3.0\nwall\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n",
      mesh.nodes.size());
  for (const Vec3& X : mesh.nodes)
    text += fmt::format("{} {} {}\n", X.x(), X.y(), X.z());
  const std::size_t each = mesh.cells.front().size();
  text += fmt::format("CELLS {} {}\n", mesh.cells.size(), mesh.cells.size() * (each + 1));
  for (const auto& cell : mesh.cells)
    text += fmt::format("{} {}\n", each, joined(cell, 0, " "));
  text += fmt::format("CELL_TYPES {}\n", mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    text += fmt::format("{}\n", type);
  return text;
}

std::string quadratic_abaqus(const test::Quadratic& mesh, const char* type) {
  std::string text = "*Node\n";
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    text += fmt::format("{}, {}, {}, {}\n", a + 1, mesh.nodes[a].x(), mesh.nodes[a].y(),
                        mesh.nodes[a].z());
  text += fmt::format("*Element, type={}\n", type);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    text += fmt::format("{}, {}\n", c + 1, joined(mesh.cells[c], 1, ", "));
  return text;
}

std::string quadratic_gmsh(const test::Quadratic& mesh, int type) {
  std::string text =
      fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", mesh.nodes.size());
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    text += fmt::format("{} {} {} {}\n", a + 1, mesh.nodes[a].x(), mesh.nodes[a].y(),
                        mesh.nodes[a].z());
  text += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    text += fmt::format("{} {} 2 1 1 {}\n", c + 1, type, joined(mesh.cells[c], 1, " "));
  return text + "$EndElements\n";
}

template <class Number>
void append(std::string& bytes, Number value) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), &value, sizeof(Number));
  bytes.append(raw.begin(), raw.end());
}

/// A tetrahedron with a corner at (10, 20, 30) and edges of 2 along the axes.
constexpr std::array<std::array<int, 3>, 4> corners{
    {{10, 20, 30}, {12, 20, 30}, {10, 22, 30}, {10, 20, 32}}};
constexpr std::array<std::array<int, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

std::string stl_text(const std::string& title) {
  std::string text = "solid " + title + "\n";
  for (const auto& face : faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face)
      text += fmt::format("vertex {}\n", fmt::join(corners[corner], " "));
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

std::string stl_bytes(std::string title) {
  title.resize(80, ' ');
  append(title, static_cast<std::uint32_t>(faces.size()));
  for (const auto& face : faces) {
    for (int d = 0; d < 3; ++d)
      append(title, 0.0F);
    for (const int corner : face)
      for (const int x : corners[corner])
        append(title, static_cast<float>(x));
    append(title, std::uint16_t{0});
  }
  return title;
}

std::string ply_text(const std::string& comment) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\ncomment {}\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n",
      comment);
  for (const auto& corner : corners)
    text += fmt::format("{}\n", fmt::join(corner, " "));
  for (const auto& face : faces)
    text += fmt::format("3 {}\n", fmt::join(face, " "));
  return text;
}

std::string vtk_polygons(const std::string& title, const std::string& field = "") {
  std::string text = fmt::format(
      "# vtk DataFile Version 3.0\n{}\nASCII\nDATASET POLYDATA\n{}POINTS 4 double\n", title, field);
  for (const auto& corner : corners)
    text += fmt::format("{}\n", fmt::join(corner, " "));
  text += "POLYGONS 4 16\n";
  for (const auto& face : faces)
    text += fmt::format("3 {}\n", fmt::join(face, " "));
  return text;
}

/// What an XML file of VTK says of its space: characters as numbers, then 0.
std::string space_field(const std::string& space) {
  std::string numbers;
  for (const char c : space)
    numbers += fmt::format("{} ", static_cast<int>(c));
  return fmt::format(
      "<FieldData>\n<Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" "
      "format=\"ascii\">\n{}0\n</Array>\n</FieldData>\n",
      numbers);
}

std::string vtp_polygons(const std::string& field) {
  Mesh mesh;
  for (const auto& corner : corners)
    mesh.nodes.emplace_back(corner[0], corner[1], corner[2]);
  Surface surface{.nodes_per_face = 3, .nodes = {}};
  for (const auto& face : faces)
    surface.nodes.insert(surface.nodes.end(), face.begin(), face.end());
  return replaced(test::vtp_text(mesh, surface, -1), "<PolyData>\n", "<PolyData>\n" + field);
}

bool contains(const std::string& ending, const std::string& bytes, const Vec3& x) {
  const test::TemporaryFile file(ending, bytes);
  return mesh_io::read_closed_surface(file.path(), 1.0).contains(x);
}

}  // namespace

TEST_CASE(
    "a physical group of Gmsh 2.2 holds the elements that bear it, whatever their elementary tag",
    "[unit][mesh_io]") {
  ImportParameters parameters;
  parameters.infarct_set = "scar";
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    const std::vector<bool> scar = some_cells(mesh);
    for (const auto& elementary : std::vector<std::function<int(int)>>{
             [](int) { return 1; }, [](int) { return 0; }, [](int group) { return 10 - group; }}) {
      const ImportedMesh imported =
          import_text(".msh", test::gmsh22_text(mesh, scar, elementary), parameters);
      check_sides(imported.mesh, mesh);
      CHECK((imported.infarcted == scar));
      CHECK(imported.notes.empty());
    }
  }
}

TEST_CASE("binary files of Gmsh 2.2 are read in both orders of bytes", "[unit][mesh_io]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    check_sides(import_text(".msh", test::gmsh22_bytes(mesh, true)).mesh, mesh);
    const std::string bytes = test::gmsh22_bytes(mesh, false);
    check_sides(import_text(".msh", bytes).mesh, mesh);
    for (const double share : {0.2, 0.6, 0.95})
      CHECK_THAT(refusal([&] {
                   return import_text(
                       ".msh", bytes.substr(0, static_cast<std::size_t>(
                                                   share * static_cast<double>(bytes.size()))));
                 }),
                 Contains("cannot be read") && Contains("truncated or damaged"));
  }
}

TEST_CASE("files of Gmsh 4.1 are read as text and bytes, whole and of partitions",
          "[unit][mesh_io]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    for (const auto numbers :
         {test::GmshNumbers::text, test::GmshNumbers::bytes, test::GmshNumbers::swapped_bytes})
      for (const bool partitioned : {false, true})
        check_sides(import_text(".msh", test::gmsh41(mesh, numbers, partitioned)).mesh, mesh);
    const std::string bytes = test::gmsh41(mesh, test::GmshNumbers::bytes);
    CHECK_THAT(refusal([&] { return import_text(".msh", replaced(bytes, "4.1 1 8", "4.1 1 4")); }),
               Contains("counts have 4 bytes, not 8"));
  }
}

TEST_CASE("an element of Gmsh 2.2 that stands there once for each of its groups is one element",
          "[unit][mesh_io]") {
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  std::string text = test::gmsh22_text(mesh);
  std::string more;
  int count = mesh.endo.size() + mesh.epi.size() + mesh.base.size() + mesh.cell_count();
  const std::string all = fmt::format("$Elements\n{}\n", count);
  for (int c = 0; c < 4; ++c)
    more += fmt::format("{} 5 2 2 1 {}\n", ++count,
                        joined({mesh.cell(c).begin(), mesh.cell(c).end()}, 1, " "));
  text = replaced(replaced(text, all, fmt::format("$Elements\n{}\n", count)), "$EndElements",
                  more + "$EndElements");
  ImportParameters parameters;
  parameters.infarct_set = "scar";
  const ImportedMesh imported = import_text(".msh", text, parameters);
  check_sides(imported.mesh, mesh);
  CHECK(std::count(imported.infarcted.begin(), imported.infarcted.end(), true) == 4);
  REQUIRE(imported.notes.size() == 1);
  CHECK_THAT(imported.notes[0], Contains("4 elements that stand in the file once for each"));
}

TEST_CASE("elements of Gmsh 2.2 may be numbered anew for volumes", "[unit][mesh_io]") {
  const Mesh mesh = test::coarse_mesh(CellKind::tetrahedron);
  std::string text = test::gmsh22_text(mesh);
  const int faces = mesh.endo.size() + mesh.epi.size() + mesh.base.size();
  for (int c = 0; c < mesh.cell_count(); ++c)
    text =
        replaced(text, fmt::format("\n{} 4 2 1", faces + c + 1), fmt::format("\n{} 4 2 1", c + 1));
  check_sides(import_text(".msh", text).mesh, mesh);
}

TEST_CASE("damaged lines of Gmsh 2.2 are named", "[unit][mesh_io]") {
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  const std::string text = test::gmsh22_text(mesh);
  const auto message = [&](const std::string& from, const std::string& to) {
    return refusal([&] { return import_text(".msh", replaced(text, from, to)); });
  };
  CHECK_THAT(message("\n7 ", "\n6 "), Contains("node 6 is defined a second time"));
  CHECK_THAT(message("\n7 ", "\nx "), Contains("\"x\" is not a number"));
  CHECK_THAT(message("\n1 3 2 ", "\n1 77 2 "), Contains("elements of type 77 are not known"));
  CHECK_THAT(message("$EndElements", "9 9 9\n$EndElements"),
             Contains("$Elements does not end where its count says"));
  CHECK_THAT(message("$Nodes", "$Knots"), Contains("$EndKnots is missing"));
}

TEST_CASE("quadratic elements are read by their corners, with a note", "[unit][mesh_io]") {
  for (const CellKind kind : kinds) {
    const bool hexahedra = kind == CellKind::hexahedron;
    const Mesh mesh = test::coarse_mesh(kind);
    const test::Quadratic quadratic = test::quadratic(mesh);
    for (const ImportedMesh& imported :
         {import_text(".vtk", quadratic_vtk(quadratic, hexahedra ? 25 : 24), by_geometry()),
          import_text(".inp", quadratic_abaqus(quadratic, hexahedra ? "C3D20R" : "C3D10M"),
                      by_geometry()),
          import_text(".msh", quadratic_gmsh(quadratic, hexahedra ? 17 : 11), by_geometry())}) {
      check_sides(imported.mesh, mesh);
      CHECK(imported.mesh.nodes.size() == mesh.nodes.size());
      REQUIRE(imported.notes.size() == 2);
      CHECK_THAT(imported.notes[0],
                 Contains(fmt::format("{} quadratic elements were read by their corners",
                                      mesh.cell_count())));
      CHECK_THAT(imported.notes[1], Contains("nodes that no element uses were dropped"));
    }
  }
}

TEST_CASE("sides come from files of their surfaces, by the numbers of nodes or by place",
          "[unit][mesh_io]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    const std::string plain = test::vtu_text(mesh, VtkTags::none);
    std::vector<int> numbers;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      numbers.push_back(static_cast<int>(a) + 1);
    const std::string numbered =
        replaced(plain, "<PointData>\n",
                 fmt::format("<PointData>\n<DataArray type=\"Int32\" Name=\"GlobalNodeID\" "
                             "format=\"ascii\">\n{}\n</DataArray>\n",
                             fmt::join(numbers, "\n")));
    for (const int first : {1, -1}) {
      const test::TemporaryFile endo(".vtp", test::vtp_text(mesh, mesh.endo, first));
      const test::TemporaryFile epi(".vtp", test::vtp_text(mesh, mesh.epi, first));
      const test::TemporaryFile base(".VTP", test::vtp_text(mesh, mesh.base, first));
      ImportParameters parameters;
      parameters.endo = endo.path();
      parameters.epi = epi.path();
      parameters.base = base.path();
      check_sides(import_text(".vtu", numbered, parameters).mesh, mesh);
      check_sides(import_text(".vtu", plain, parameters).mesh, mesh);
      Mesh moved = mesh;
      for (Vec3& X : moved.nodes)
        X.x() += 5.0;
      CHECK_THAT(refusal([&] {
                   return import_text(".vtu", test::vtu_text(moved, VtkTags::none), parameters);
                 }),
                 Contains("no node of the mesh lies at point"));
    }
    const test::TemporaryFile other(".vtp", test::vtp_text(mesh, mesh.endo, 1000000));
    ImportParameters parameters;
    parameters.endo = other.path();
    CHECK_THAT(refusal([&] { return import_text(".vtu", numbered, parameters); }),
               Contains("GlobalNodeID 10") && Contains("is no node of the mesh"));
  }
}

TEST_CASE("a face of the base with all its corners in another side's set of nodes is base",
          "[unit][mesh_io]") {
  for (const CellKind kind : kinds) {
    const Mesh mesh = test::coarse_mesh(kind);
    Mesh tagged = mesh;  // two faces of the base whose nodes are all in the set of another side
    for (auto* side : {&tagged.endo.nodes, &tagged.epi.nodes}) {
      const int f = side == &tagged.endo.nodes ? 0 : mesh.base.size() / 2;
      const auto face = mesh.base.face(f);
      for (int i = 0; i < tagged.endo.nodes_per_face; ++i)
        side->push_back(face[i]);
    }
    check_sides(import_text(".inp", test::abaqus_text(tagged, AbaqusTags::node_sets)).mesh, mesh);
    check_sides(import_text(".vtu", test::vtu_text(tagged, VtkTags::point_arrays)).mesh, mesh);
  }
}

TEST_CASE("a face that is in the sets of endocardium and epicardium alone is refused",
          "[unit][mesh_io]") {
  Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  for (int i = 0; i < 4; ++i)
    mesh.epi.nodes.push_back(mesh.endo.face(0)[i]);
  CHECK_THAT(
      refusal([&] { return import_text(".inp", test::abaqus_text(mesh, AbaqusTags::node_sets)); }),
      Contains("is tagged both as endocardium and as epicardium"));
}

TEST_CASE("a surface that says SPACE=RAS is turned to LPS, one that says nothing is not",
          "[unit][mesh_io]") {
  const Vec3 in_lps(10.5, 20.5, 30.5);
  const Vec3 from_ras(-10.5, -20.5, 30.5);
  struct Format {
    const char* ending;
    std::function<std::string(const std::string& space)> bytes;
  };
  const auto said = [](const std::string& space) {
    return space.empty() ? std::string("Slicer") : "3D Slicer output. SPACE=" + space;
  };
  for (const Format& format : std::vector<Format>{
           {".stl", [&](const std::string& s) { return stl_text(said(s)); }},
           {".STL", [&](const std::string& s) { return stl_bytes(said(s)); }},
           {".ply", [&](const std::string& s) { return ply_text(said(s)); }},
           {".vtk", [&](const std::string& s) { return vtk_polygons(said(s)); }},
           {".vtk",
            [&](const std::string& s) {
              return vtk_polygons(
                  "x", s.empty() ? "" : "FIELD FieldData 1\nSPACE 1 1 string\n" + s + "\n");
            }},
           {".vtp",
            [&](const std::string& s) { return vtp_polygons(s.empty() ? "" : space_field(s)); }}}) {
    INFO(format.ending);
    CHECK(contains(format.ending, format.bytes("RAS"), from_ras));
    CHECK_FALSE(contains(format.ending, format.bytes("RAS"), in_lps));
    for (const char* space : {"LPS", ""}) {
      CHECK(contains(format.ending, format.bytes(space), in_lps));
      CHECK_FALSE(contains(format.ending, format.bytes(space), from_ras));
    }
    CHECK_THAT(refusal([&] { contains(format.ending, format.bytes("LAS"), in_lps); }),
               Contains("says SPACE=LAS. Coordinates are read in LPS"));
  }
  CHECK(contains(".ply", ply_text("COLOUR SPACE=sRGB, WHITESPACE=none"), in_lps));
}

TEST_CASE("a mesh that says SPACE=RAS is turned to LPS, with a note", "[unit][mesh_io]") {
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  Mesh in_ras = mesh;
  for (Vec3& X : in_ras.nodes)
    X = Vec3(-X.x() + 5.0, -X.y() - 7.0, X.z());
  const Vec3 first(mesh.nodes[0].x() - 5.0, mesh.nodes[0].y() + 7.0, mesh.nodes[0].z());
  struct File {
    const char* ending;
    std::string text;
  };
  for (const auto& [ending, text] :
       {File{".vtk", replaced(test::vtk_text(in_ras, VtkTags::point_arrays), "\na wall\n",
                              "\n3D Slicer output. SPACE=RAS\n")},
        File{".vtu", replaced(test::vtu_text(in_ras, VtkTags::point_arrays), "<UnstructuredGrid>\n",
                              "<UnstructuredGrid>\n" + space_field("RAS"))},
        File{".inp", "** SPACE=RAS\n" + test::abaqus_text(in_ras, AbaqusTags::node_sets)},
        File{".msh", replaced(test::gmsh22_text(in_ras), "$Nodes",
                              "$Comments\nSPACE=RAS\n$EndComments\n$Nodes")}}) {
    INFO(ending);
    const ImportedMesh imported = import_text(ending, text);
    check_sides(imported.mesh, mesh);
    CHECK((imported.frame.to_image(imported.mesh.nodes[0]) - first).norm() < 1e-9);
    REQUIRE(imported.notes.size() == 1);
    CHECK_THAT(imported.notes[0], Contains("SPACE=RAS"));
  }
}

TEST_CASE("a labelled volume that says SPACE=RAS is turned to LPS", "[unit][mesh_io]") {
  const auto volume = [](const std::string& title) {
    const test::TemporaryFile file(
        ".VTK", "# vtk DataFile Version 3.0\n" + title +
                    "\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nORIGIN 10 20 30\n"
                    "SPACING 1 1 1\nPOINT_DATA 8\nSCALARS tissue int 1\nLOOKUP_TABLE default\n"
                    "1 2 2 2 2 2 2 2\n");
    return mesh_io::LabelVolume(file.path(), "", 1.0);
  };
  CHECK(volume("x").has({10.0, 20.0, 30.0}, {1}));
  CHECK(volume("SPACE=RAS").has({-10.0, -20.0, 30.0}, {1}));
  CHECK_FALSE(volume("SPACE=RAS").has({10.0, 20.0, 30.0}, {1, 2}));
  CHECK((volume("SPACE=RAS").box().min() - Vec3(-11.0, -21.0, 30.0)).norm() < 1e-12);
}

TEST_CASE("a refusal lists all formats that are read, and endings may be in capitals",
          "[unit][mesh_io]") {
  const test::TemporaryFile nrrd(".nrrd", "NRRD0004\n");
  CHECK_THAT(refusal([&] { mesh_io::LabelVolume(nrrd.path(), "", 1.0); }),
             Contains("unknown ending \".nrrd\"") && Contains(".nii, .nii.gz") &&
                 Contains(".vti and .vtk"));
  CHECK_THAT(refusal([&] { static_cast<void>(mesh_io::read_closed_surface(nrrd.path(), 1.0)); }),
             Contains(".stl, .ply, .obj, .vtp and .vtk"));
  ImportParameters parameters;
  parameters.file = nrrd.path();
  CHECK_THAT(refusal([&] { static_cast<void>(mesh_io::import_mesh(parameters)); }),
             Contains(".inp (ABAQUS), .vtk, .vtu (VTK) and .msh (Gmsh)"));
}

TEST_CASE("ABAQUS files may have exponents of Fortran and ends of lines of old Macs",
          "[unit][mesh_io]") {
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  std::string text = test::abaqus_text(mesh, AbaqusTags::node_sets);
  text = replaced(text, "1, ", fmt::format("1, {:.1f}D+00, ", mesh.nodes[0].x()));
  text = replaced(text, fmt::format("D+00, {}", mesh.nodes[0].x()), "D+00");
  std::replace(text.begin(), text.end(), '\n', '\r');
  check_sides(import_text(".inp", text).mesh, mesh);
}

TEST_CASE("files in UTF-16 are refused by what they are", "[unit][mesh_io]") {
  const auto utf16 = [](const std::string& text) {
    std::string bytes = "\xFF\xFE";
    for (const char c : text)
      bytes += {c, '\0'};
    return bytes;
  };
  const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  for (const auto& [ending, text] :
       {std::pair{".inp", test::abaqus_text(mesh, AbaqusTags::node_sets)},
        {".vtk", test::vtk_text(mesh, VtkTags::point_arrays)},
        {".vtu", test::vtu_text(mesh, VtkTags::point_arrays)},
        {".msh", test::gmsh22_text(mesh)}})
    CHECK_THAT(refusal([&, e = ending, t = text] { return import_text(e, utf16(t)); }),
               Contains("is not UTF-8 text but UTF-16"));
  CHECK_THAT(refusal([&] { contains(".stl", utf16(stl_text("x")), Vec3::Zero()); }),
             Contains("is not UTF-8 text but UTF-16"));
}
