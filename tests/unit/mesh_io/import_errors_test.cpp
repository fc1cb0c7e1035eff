#include "lv/base/check.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh_io/import.hpp"

#include "mesh_io/mesh_files.hpp"
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace {

using namespace lv;
using Catch::Matchers::Contains;
using mesh::CellKind;
using mesh::ImportParameters;
using mesh::Mesh;
using test::AbaqusTags;
using test::by_geometry;
using test::replaced;
using test::VtkTags;

/// The error's text after the path of the file.
std::string message(const ImportParameters& parameters) {
  try {
    static_cast<void>(mesh_io::import_mesh(parameters));
  } catch (const InputError& error) {
    const std::string text = error.what();
    CHECK(text.starts_with(parameters.file));
    return text.substr(std::min(parameters.file.size(), text.size()));
  }
  return "no error";
}

std::string message(const std::string& ending, const std::string& text,
                    ImportParameters parameters = {}) {
  const test::TemporaryFile file(ending, text);
  parameters.file = file.path();
  return message(parameters);
}

std::string abaqus_message(const Mesh& mesh, ImportParameters parameters = {}) {
  return message(".inp", test::abaqus_text(mesh, AbaqusTags::node_sets), std::move(parameters));
}

/// The line of `text` that starts with `start`, from 1.
int line_of(const std::string& text, const std::string& start) {
  const auto at = text.find("\n" + start);
  REQUIRE(at != std::string::npos);
  return 2 + static_cast<int>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

const Mesh& hexahedra() {
  static const Mesh mesh = test::coarse_mesh(CellKind::hexahedron);
  return mesh;
}

/// A node inside the wall.
int inner_node(const Mesh& mesh) {
  for (int node = 0;; ++node)
    if (mesh.transmural[node] > 0.3 && mesh.transmural[node] < 0.7 && mesh.nodes[node].z() < -30.0)
      return node;
}

}  // namespace

TEST_CASE("missing files and unknown formats are named", "[unit][mesh_io]") {
  ImportParameters parameters;
  parameters.file = "no/such/mesh.inp";
  CHECK_THAT(message(parameters), Contains("there is no such file"));
  CHECK_THAT(message(".stl", "solid"),
             Contains("unknown ending \".stl\"") && Contains(".vtu (VTK)"));
  CHECK_THAT(message(".msh", "$NOD\n1\n"), Contains(":1: is not a Gmsh mesh"));
  CHECK_THAT(message(".msh", "$MeshFormat\n3 0 8\n"), Contains(":2: has Gmsh's mesh format 3"));
  CHECK_THAT(message(".vtk", "solid"), Contains("is not a VTK file of an unstructured grid"));
  CHECK_THAT(message(".vtu", "solid"), Contains("is not a VTK file of type UnstructuredGrid"));
  CHECK_THAT(message(".inp", "1, 2, 3\n"), Contains(":1: has data before the first keyword"));
  CHECK_THAT(message(".inp", ""), Contains("holds no volume cells"));
}

TEST_CASE("a truncated ABAQUS file is refused at the line where it ends", "[unit][mesh_io]") {
  const std::string text = test::abaqus_text(hexahedra(), AbaqusTags::node_sets);
  const auto cut_in = [&](const std::string& start, std::size_t kept) {
    return text.substr(0, text.find("\n" + start) + 1 + kept);
  };
  CHECK_THAT(message(".inp", cut_in("9, ", 8)),
             Contains(fmt::format(":{}: ", line_of(text, "9, "))) &&
                 Contains("is not a node's number and three coordinates") && Contains("truncated"));
  const std::string elements = text.substr(text.find("*Element"));
  const std::string in_element =
      text.substr(0, text.find("*Element") + elements.find("\n9, ") + 12);
  CHECK_THAT(message(".inp", in_element), Contains("element 9 has") && Contains("of its 8 nodes"));
  CHECK_THAT(message(".inp", cut_in("*NSET, NSET=base", 20)),
             Contains("*Part is not followed by *End Part. The file seems to be truncated"));
}

TEST_CASE("truncated VTK and Gmsh files are refused wherever they end", "[unit][mesh_io]") {
  struct Format {
    const char* ending;
    std::string text;
  };
  for (const auto& [ending, text] :
       {Format{".vtk", test::vtk_text(hexahedra(), VtkTags::point_arrays)},
        Format{".vtu", test::vtu_text(hexahedra(), VtkTags::point_arrays)},
        Format{".msh", test::gmsh22_text(hexahedra())},
        Format{".msh", test::gmsh41(hexahedra())}}) {
    for (const double share : {0.0, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97}) {
      INFO(ending << " cut at " << share);
      const auto kept = static_cast<std::size_t>(share * static_cast<double>(text.size()));
      CHECK_THAT(message(ending, text.substr(0, kept)), !Contains("no error"));
    }
  }
}

TEST_CASE("damaged lines of an ABAQUS file are named", "[unit][mesh_io]") {
  const std::string text = test::abaqus_text(hexahedra(), AbaqusTags::node_sets);
  const int node = line_of(text, "3, ");
  CHECK_THAT(message(".inp", replaced(text, "\n3, ", "\n3, x")),
             Contains(fmt::format(":{}: \"x", node)) && Contains("is not a coordinate"));
  CHECK_THAT(message(".inp", replaced(text, "\n3, ", "\n2, ")),
             Contains(fmt::format(":{}: node 2 is defined a second time", node)));
  CHECK_THAT(message(".inp", replaced(text, "\n3, ", "\n300000, ")),
             Contains("uses node 3, which is not defined"));
  CHECK_THAT(message(".inp", replaced(text, "*Node", "*Node, system=C")), Contains("cylindrical"));
  CHECK_THAT(message(".inp", replaced(text, "*Node", "*Ngen\n1, 2\n*Node")),
             Contains(":4: *NGEN is not understood"));
  CHECK_THAT(message(".inp", replaced(text, "*End Part", "*Nset, nset=more\nnone\n*End Part")),
             Contains("there is no set \"none\" before this line"));
}

TEST_CASE("volume cells of other kinds are counted", "[unit][mesh_io]") {
  const std::string text = test::abaqus_text(hexahedra(), AbaqusTags::node_sets);
  CHECK_THAT(message(".inp", replaced(text, "*End Part",
                                      "*Element, type=C3D6\n9999, 1,2,3,4,5,6\n"
                                      "*End Part")),
             Contains("cannot be used together") && Contains("1 of shape wedge") &&
                 Contains(fmt::format("{} of shape hexahedron", hexahedra().cell_count())));
  CHECK_THAT(message(".inp", "*Element, type=C3D15\n1, 1,2,3,4,5,6,7,8,9,\n10,11,12,13,14,15\n"),
             Contains("1 of shape quadratic wedge"));
  CHECK_THAT(message(".inp", "*Element, type=S4\n1, 1,2,3,4\n"), Contains("holds no volume cells"));
  CHECK_THAT(message(".vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                     "POINTS 6 double\n0 0 0 1 0 0 0 1 0 0 0 1 1 0 1 0 1 1\nCELLS 1 7\n"
                     "6 0 1 2 3 4 5\nCELL_TYPES 1\n13\n"),
             Contains("1 of shape vtkWedge"));
  CHECK_THAT(message(".msh",
                     "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n"
                     "3 0 1 0\n4 0 0 1\n5 1 0 1\n6 0 1 1\n$EndNodes\n$Elements\n1\n"
                     "1 6 2 0 1 1 2 3 4 5 6\n$EndElements\n"),
             Contains("1 of shape Prism 6"));
}

TEST_CASE("inverted and collapsed elements are named with their number and place",
          "[unit][mesh_io]") {
  Mesh mesh = hexahedra();
  const std::string text = test::abaqus_text(mesh, AbaqusTags::node_sets);
  std::swap_ranges(mesh.cells.begin() + 80, mesh.cells.begin() + 84, mesh.cells.begin() + 84);
  const std::string elements = text.substr(0, text.find("*Element"));
  const int line = static_cast<int>(std::count(elements.begin(), elements.end(), '\n')) + 12;
  CHECK_THAT(abaqus_message(mesh),
             Contains(fmt::format(":{}: 1 of {} elements are inverted", line, mesh.cell_count())) &&
                 Contains("the worst is element 11 at (") && Contains("Repair"));
  mesh = hexahedra();
  mesh.nodes[inner_node(mesh)] *= 0.2;
  CHECK_THAT(abaqus_message(mesh),
             Contains("elements are inverted or flat; the worst is element "));
  mesh = hexahedra();
  for (int c = 0; c < mesh.cell_count(); ++c) {  // lexicographic order
    std::swap(mesh.cells[8 * c + 2], mesh.cells[8 * c + 3]);
    std::swap(mesh.cells[8 * c + 6], mesh.cells[8 * c + 7]);
  }
  CHECK_THAT(abaqus_message(mesh), Contains("Are the nodes in the order of the file's format?"));
  mesh = hexahedra();
  mesh.cells[81] = mesh.cells[80];
  CHECK_THAT(abaqus_message(mesh),
             Contains("1 elements use one node twice, the first is element 11 at ("));
}

TEST_CASE("cracks, loose parts and doubled elements are counted", "[unit][mesh_io]") {
  Mesh cracked = hexahedra();
  const int torn = inner_node(cracked);
  cracked.nodes.push_back(cracked.nodes[torn]);
  *std::find(cracked.cells.begin(), cracked.cells.end(), torn) =
      static_cast<int>(cracked.nodes.size()) - 1;
  CHECK_THAT(
      abaqus_message(cracked),
      Contains(fmt::format("1 pairs of nodes lie in one place, which leaves cracks in the wall; "
                           "the first are node {} at (",
                           torn + 1)) &&
          Contains(fmt::format(") and node {}. Merge", cracked.nodes.size())));

  Mesh twice = hexahedra();  // two walls in one place
  const int count = static_cast<int>(twice.nodes.size());
  for (int i = 0; i < count; ++i)
    twice.nodes.push_back(Vec3(hexahedra().nodes[i]));
  for (const int node : hexahedra().cells)
    twice.cells.push_back(node + count);
  CHECK_THAT(abaqus_message(twice), Contains("breaks the wall into 2 unconnected parts"));
  for (int i = 0; i < count; ++i)
    twice.nodes[count + i].x() += 90.0;
  CHECK_THAT(abaqus_message(twice), Contains("the wall consists of 2 unconnected parts"));

  Mesh doubled = hexahedra();
  const std::vector<int> cells(doubled.cells.begin(), doubled.cells.begin() + 16);
  doubled.cells.insert(doubled.cells.end(), cells.begin(), cells.end());
  CHECK_THAT(abaqus_message(doubled), Contains("faces belong to more than two elements"));
}

TEST_CASE("a missing tag lists those that exist and suggests the nearest", "[unit][mesh_io]") {
  ImportParameters parameters;
  parameters.epi = "epo";
  CHECK_THAT(
      abaqus_message(hexahedra(), parameters),
      Contains("has no *Surface, *Elset or *Nset \"epo\"; it has BASE, ENDO, EPI. Did you mean "
               "\"EPI\"?"));
  CHECK_THAT(
      message(".msh", test::gmsh41(hexahedra()), parameters),
      Contains("has no physical surface \"epo\"; it has endo, epi, base. Did you mean \"epi\"?"));
  CHECK_THAT(message(".vtk", test::vtk_text(hexahedra(), VtkTags::point_arrays), parameters),
             Contains("has no point array \"epo\"; it has") && Contains("Did you mean \"epi\"?"));
  parameters.side_array = "sides";
  CHECK_THAT(message(".vtu", test::vtu_text(hexahedra(), VtkTags::surface_cells), parameters),
             Contains("has no cell array \"sides\"; it has side. Did you mean \"side\"?"));
  parameters.side_array = "side";
  CHECK_THAT(message(".vtu", test::vtu_text(hexahedra(), VtkTags::surface_cells), parameters),
             Contains("\"endo\" is not a number of the cell array \"side\""));
  parameters.endo = "1";
  parameters.epi = "7";
  CHECK_THAT(message(".vtu", test::vtu_text(hexahedra(), VtkTags::surface_cells), parameters),
             Contains("has no surface cell whose \"side\" is \"7\"; it has 1, 2, 3"));
  CHECK_THAT(message(".inp", test::abaqus_text(hexahedra(), AbaqusTags::none)),
             Contains("has no *Surface, *Elset or *Nset \"endo\", nor any other. Tag it"));
}

TEST_CASE("sides that overlap, leave gaps or lie inside are refused with the place",
          "[unit][mesh_io]") {
  Mesh mesh = hexahedra();
  mesh.epi.nodes.insert(mesh.epi.nodes.end(), mesh.base.nodes.begin(), mesh.base.nodes.begin() + 4);
  CHECK_THAT(message(".inp", test::abaqus_text(mesh, AbaqusTags::shells)),
             Contains("is tagged both as epicardium and as base"));
  mesh = hexahedra();
  mesh.epi.nodes.resize(mesh.epi.nodes.size() - 12);
  CHECK_THAT(message(".inp", test::abaqus_text(mesh, AbaqusTags::labelled_faces)),
             Contains("3 of the ") && Contains("boundary faces belong to no side, the first at ("));
  mesh = hexahedra();
  mesh.epi.nodes[0] = inner_node(mesh);
  CHECK_THAT(
      message(".msh", test::gmsh22_text(mesh)),
      Contains("1 of the ") && Contains("faces tagged as epicardium are not faces of the wall's"));
  mesh = hexahedra();
  std::swap(mesh.endo, mesh.epi);
  CHECK_THAT(message(".msh", test::gmsh22_text(mesh)), Contains("exchanged?"));
}

TEST_CASE("a wall that is open at the apex or has no opening is refused", "[unit][mesh_io]") {
  Mesh open = hexahedra();
  std::vector<int> cells;
  for (int c = 0; c < open.cell_count(); ++c)
    if (open.nodes[open.cell(c)[0]].z() > -50.0)
      cells.insert(cells.end(), open.cell(c).begin(), open.cell(c).end());
  open.cells = cells;
  CHECK_THAT(message(".inp", test::abaqus_text(open, AbaqusTags::none), by_geometry()),
             Contains("the wall has a hole near ("));
  CHECK_THAT(abaqus_message(open), Contains("belong to no side"));
}

TEST_CASE("a base that is not plane is refused with its worst node", "[unit][mesh_io]") {
  Mesh mesh = hexahedra();
  const int node = mesh.base.nodes[0];
  mesh.nodes[node].z() += 1.0;
  CHECK_THAT(abaqus_message(mesh),
             Contains(fmt::format("the base is not plane: node {} at (", node + 1)) &&
                 Contains("raise anatomy.mesh.base_tolerance, 0.1 mm"));
  CHECK_THAT(message(".inp", test::abaqus_text(mesh, AbaqusTags::none), by_geometry()),
             Contains("the base is not plane: the face at ("));
}

TEST_CASE("places that are no numbers are refused", "[unit][mesh_io]") {
  Mesh mesh = hexahedra();
  mesh.nodes[17].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(abaqus_message(mesh), Contains(":22: node 18 at (") && Contains("is not a place"));
  CHECK_THAT(message(".vtu", test::vtu_text(mesh, VtkTags::point_arrays)), !Contains("no error"));
}

TEST_CASE("a wall of impossible size is refused with the unit it looks like", "[unit][mesh_io]") {
  Mesh mesh = hexahedra();
  for (Vec3& X : mesh.nodes)
    X /= 10.0;
  CHECK_THAT(abaqus_message(mesh),
             Contains("with a unit of 1 mm the wall measures 8.9 mm; from a "
                      "ventricle 20 to 200 mm are expected. The file's unit looks "
                      "like cm: set anatomy.mesh.length_unit, with the line "
                      "length_unit = \"10 mm\" under [anatomy.mesh]"));
  ImportParameters parameters;
  parameters.unit = 1000.0;
  CHECK_THAT(
      abaqus_message(hexahedra(), parameters),
      Contains(
          "looks like mm: set anatomy.mesh.length_unit, with the line length_unit = \"1 mm\""));
  for (Vec3& X : mesh.nodes)
    X /= 1e6;
  CHECK_THAT(abaqus_message(mesh), Contains("Check the mesh and its unit"));
}

TEST_CASE("infarct fields and point tags outside their range are refused", "[unit][mesh_io]") {
  Mesh mesh = hexahedra();
  mesh.infarct[4] = 1.5;
  CHECK_THAT(message(".vtu", test::vtu_text(mesh, VtkTags::point_arrays)),
             Contains("the infarct field is 1.5 at node 4 at ("));
  ImportParameters parameters;
  parameters.infarct_array = "scar";
  CHECK_THAT(message(".vtu", test::vtu_text(hexahedra(), VtkTags::point_arrays), parameters),
             Contains("has no point array \"scar\"; it has infarct, endo, epi, base"));
  parameters = {};
  parameters.endo = "infarct";
  mesh.infarct[4] = 0.5;
  CHECK_THAT(message(".vtk", test::vtk_text(mesh, VtkTags::point_arrays), parameters),
             Contains("point array \"infarct\" is 0.5 at point 4. It must be 1 on the side"));
}
