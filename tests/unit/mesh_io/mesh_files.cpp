#include "mesh_io/mesh_files.hpp"

#include "lv/mesh/cell.hpp"
#include "lv/mesh/split.hpp"
#include "lv/mesh/surface.hpp"
#include "lv/mesh/wall_mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>

namespace lv::test {
namespace {

using mesh::CellKind;
using mesh::Mesh;
using mesh::Surface;

std::array<const Surface*, 3> sides(const Mesh& mesh) {
  return {&mesh.endo, &mesh.epi, &mesh.base};
}
constexpr std::array<const char*, 3> names{"endo", "epi", "base"};

/// "a, b, c" with 1 added to each.
std::string from_one(std::span<const int> nodes, const char* separator) {
  std::vector<int> numbers;
  for (const int node : nodes)
    numbers.push_back(node + 1);
  return fmt::format("{}", fmt::join(numbers, separator));
}

std::string abaqus_face_sets(const Mesh& mesh) {
  std::map<mesh::FaceKey, std::pair<int, int>> cell_face;
  const auto faces = mesh::cell_faces(mesh.kind);
  for (int c = 0; c < mesh.cell_count(); ++c) {
    for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
      std::vector<int> nodes;
      for (const int a : faces[f])
        if (a >= 0)
          nodes.push_back(mesh.cell(c)[a]);
      cell_face[mesh::face_key(nodes)] = {c, f};
    }
  }
  std::string text;
  for (int s = 0; s < 3; ++s) {
    std::map<int, std::vector<int>> cells_by_label;
    for (int f = 0; f < sides(mesh)[s]->size(); ++f) {
      const auto [cell, face] = cell_face.at(mesh::face_key(sides(mesh)[s]->face(f)));
      cells_by_label[face + 1].push_back(cell);
    }
    for (const auto& [label, cells] : cells_by_label)
      text += fmt::format("*Elset, elset=_{}_S{}, internal\n{}\n", names[s], label,
                          from_one(cells, ",\n"));
    text += fmt::format("*Surface, type=ELEMENT, name={}\n", names[s]);
    for (const auto& [label, cells] : cells_by_label)
      text += fmt::format("_{}_S{}, S{}\n", names[s], label, label);
  }
  return text;
}

std::string abaqus_node_sets(const Mesh& mesh) {
  std::string text;
  for (int s = 0; s < 3; ++s)
    text += fmt::format("*NSET, NSET={}\n{}\n", names[s],
                        from_one(mesh::surface_nodes(*sides(mesh)[s]), ",\n"));
  return text;
}

std::string abaqus_shells(const Mesh& mesh) {
  std::string text;
  int number = mesh.cell_count() + 1;
  for (int s = 0; s < 3; ++s) {
    text += fmt::format("*Element, type={}, elset={}\n",
                        mesh.endo.nodes_per_face == 4 ? "S4R" : "S3", names[s]);
    for (int f = 0; f < sides(mesh)[s]->size(); ++f)
      text += fmt::format("{}, {}\n", number++, from_one(sides(mesh)[s]->face(f), ", "));
  }
  return text;
}

/// Volume cells, then the surface cells of all sides.
struct VtkCells {
  std::vector<std::vector<int>> nodes;
  std::vector<int> types;
  std::vector<int> sides;  ///< 0 on volume cells
};

VtkCells vtk_cells(const Mesh& mesh, bool with_surfaces) {
  const bool hexahedra = mesh.kind == CellKind::hexahedron;
  VtkCells cells;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    cells.nodes.emplace_back(mesh.cell(c).begin(), mesh.cell(c).end());
    cells.types.push_back(hexahedra ? 12 : 10);
    cells.sides.push_back(0);
  }
  for (int s = 0; s < 3 && with_surfaces; ++s) {
    for (int f = 0; f < sides(mesh)[s]->size(); ++f) {
      const auto face = sides(mesh)[s]->face(f);
      cells.nodes.emplace_back(face.begin(), face.end());
      cells.types.push_back(hexahedra ? 9 : 5);
      cells.sides.push_back(s + 1);
    }
  }
  return cells;
}

std::vector<int> flags(const Mesh& mesh, int side) {
  std::vector<int> on(mesh.nodes.size(), 0);
  for (const int node : sides(mesh)[side]->nodes)
    on[node] = 1;
  return on;
}

std::string points_text(const Mesh& mesh) {
  std::string text;
  for (const Vec3& X : mesh.nodes)
    text += fmt::format("{} {} {}\n", X.x(), X.y(), X.z());
  return text;
}

struct GmshElement {
  int number, type, entity;
  std::span<const int> nodes;
};

std::vector<GmshElement> gmsh_elements(const Mesh& mesh, const std::vector<bool>& scar = {}) {
  const bool hexahedra = mesh.kind == CellKind::hexahedron;
  std::vector<GmshElement> elements;
  int number = 1;
  for (int s = 0; s < 3; ++s)
    for (int f = 0; f < sides(mesh)[s]->size(); ++f)
      elements.push_back({number++, hexahedra ? 3 : 2, s + 1, sides(mesh)[s]->face(f)});
  for (int c = 0; c < mesh.cell_count(); ++c)
    elements.push_back(
        {number++, hexahedra ? 5 : 4, !scar.empty() && scar[c] ? 2 : 1, mesh.cell(c)});
  return elements;
}

template <class Number>
void append(std::string& bytes, Number value, bool swapped) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), &value, sizeof(Number));
  if (swapped)
    std::reverse(raw.begin(), raw.end());
  bytes.append(raw.begin(), raw.end());
}

constexpr const char* physical_names =
    "$PhysicalNames\n5\n2 1 \"endo\"\n2 2 \"epi\"\n2 3 \"base\"\n3 1 \"wall\"\n3 2 "
    "\"scar\"\n$EndPhysicalNames\n";

/// A file of Gmsh's format 4.1, as text or bytes.
class Gmsh41Writer {
 public:
  explicit Gmsh41Writer(GmshNumbers numbers) : numbers_(numbers) {
    out_ = fmt::format("$MeshFormat\n4.1 {} 8\n", is_text() ? 0 : 1);
    if (!is_text())
      put(std::int32_t{1});
    out_ += fmt::format("\n$EndMeshFormat\n{}", physical_names);
  }

  void line(const std::string& text) { out_ += text + "\n"; }
  void wholes(std::initializer_list<std::int32_t> values) { put_all(values); }
  void sizes(std::initializer_list<std::size_t> values) { put_all(values); }
  void reals(std::initializer_list<double> values) { put_all(values); }
  [[nodiscard]] std::string text() && { return std::move(out_); }

 private:
  [[nodiscard]] bool is_text() const { return numbers_ == GmshNumbers::text; }

  template <class Number>
  void put(Number value) {
    if (is_text())
      out_ += fmt::format("{}\n", value);
    else
      append(out_, value, numbers_ == GmshNumbers::swapped_bytes);
  }
  template <class Number>
  void put_all(std::initializer_list<Number> values) {
    for (const Number value : values)
      put(value);
  }

  GmshNumbers numbers_;
  std::string out_;
};

/// Entities 1 to 3 are surfaces, each with its own group; the volume 1 has its group. Those of
/// partitions have parents and partitions.
void put_entities(Gmsh41Writer& file, bool partitioned) {
  const auto parents = [&](std::int32_t dimension, std::int32_t parent) {
    if (!partitioned)
      return;
    file.wholes({dimension, parent});
    file.sizes({2});
    file.wholes({1, 2});
  };
  file.line(partitioned ? "$PartitionedEntities" : "$Entities");
  if (partitioned) {
    file.sizes({2, 1});
    file.wholes({77, 1});
  }
  file.sizes({1, 0, 3, 1});
  file.wholes({1});
  parents(0, 1);
  file.reals({9.0, 9.0, 9.0});
  file.sizes({0});
  for (std::int32_t s = 1; s <= 3; ++s) {
    file.wholes({s});
    parents(2, s);
    file.reals({-99.0, -99.0, -99.0, 99.0, 99.0, 99.0});
    file.sizes({1});
    file.wholes({s == 2 ? -s : s});  // a negative group has its elements turned
    file.sizes({0});
  }
  file.wholes({1});
  parents(3, 1);
  file.reals({-99.0, -99.0, -99.0, 99.0, 99.0, 99.0});
  file.sizes({1});
  file.wholes({1});
  file.sizes({3});
  file.wholes({1, 2, 3});
  file.line(partitioned ? "\n$EndPartitionedEntities" : "\n$EndEntities");
}

/// The second half in the volume, then the first on a surface with coordinates on it.
void put_nodes(Gmsh41Writer& file, const Mesh& mesh) {
  const std::size_t all = mesh.nodes.size();
  file.line("$Nodes");
  file.sizes({2, all, 1, all});
  for (const bool parametric : {false, true}) {
    const std::size_t begin = parametric ? 0 : all / 2;
    const std::size_t end = parametric ? all / 2 : all;
    file.wholes({parametric ? 2 : 3, 1, parametric ? 1 : 0});
    file.sizes({end - begin});
    for (std::size_t a = begin; a < end; ++a)
      file.sizes({a + 1});
    for (std::size_t a = begin; a < end; ++a) {
      file.reals({mesh.nodes[a].x(), mesh.nodes[a].y(), mesh.nodes[a].z()});
      if (parametric)
        file.reals({0.25, 0.75});
    }
  }
  file.line("\n$EndNodes");
}

/// One block for each element, volumes before sides.
void put_elements(Gmsh41Writer& file, const Mesh& mesh) {
  auto elements = gmsh_elements(mesh);
  std::reverse(elements.begin(), elements.end());
  file.line("$Elements");
  file.sizes({elements.size(), elements.size(), 1, elements.size()});
  for (const GmshElement& e : elements) {
    file.wholes({e.type >= 4 ? 3 : 2, e.entity, e.type});
    file.sizes({1, static_cast<std::size_t>(e.number)});
    for (const int node : e.nodes)
      file.sizes({static_cast<std::size_t>(node + 1)});
  }
  file.line("\n$EndElements");
}

}  // namespace

Mesh ellipsoid_mesh(const geometry::Ellipsoid& ellipsoid, double edge_length, int layers) {
  const auto map = [&](double u, double theta, double t) { return ellipsoid.point(u, theta, t); };
  return mesh::wall_mesh(map, {edge_length, layers});
}

Mesh coarse_mesh(CellKind kind) {
  const Mesh hexahedra = ellipsoid_mesh({}, 8.0);
  return kind == CellKind::hexahedron ? hexahedra : mesh::split_into_tetrahedra(hexahedra);
}

TemporaryFile::TemporaryFile(const std::string& ending, const std::string& text) {
  static int count = 0;
  path_ = std::filesystem::temp_directory_path() /
          fmt::format("ventricle_{}_{}{}", ::getpid(), count++, ending);
  std::ofstream(path_, std::ios::binary) << text;
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

mesh_io::ImportedMesh import_text(const std::string& ending, const std::string& text,
                                  mesh::ImportParameters parameters) {
  const TemporaryFile file(ending, text);
  parameters.file = file.path();
  return mesh_io::import_mesh(parameters);
}

mesh::ImportParameters by_geometry() {
  mesh::ImportParameters parameters;
  parameters.sides = mesh::SideSource::geometry;
  return parameters;
}

mesh::ImportParameters by_cells() {
  const std::array<std::string, 3> numbers{"1", "2", "3"};
  mesh::ImportParameters parameters;
  parameters.side_array = "side";
  parameters.endo = numbers[0];
  parameters.epi = numbers[1];
  parameters.base = numbers[2];
  return parameters;
}

std::string abaqus_text(const Mesh& mesh, AbaqusTags tags) {
  std::string text = "** a wall\n*Heading\n*Part, name=WALL\n*Node\n";
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    text += fmt::format("{}, {}, {}, {}\n", i + 1, mesh.nodes[i].x(), mesh.nodes[i].y(),
                        mesh.nodes[i].z());
  text += fmt::format("*Element, type={}\n", mesh.kind == CellKind::hexahedron ? "C3D8H" : "C3D4");
  for (int c = 0; c < mesh.cell_count(); ++c)
    text += fmt::format("{}, {}\n", c + 1, from_one(mesh.cell(c), ", "));
  if (tags == AbaqusTags::labelled_faces)
    text += abaqus_face_sets(mesh);
  if (tags == AbaqusTags::node_sets)
    text += abaqus_node_sets(mesh);
  if (tags == AbaqusTags::shells)
    text += abaqus_shells(mesh);
  return text + "*End Part\n";
}

std::string vtk_text(const Mesh& mesh, VtkTags tags) {
  const VtkCells cells = vtk_cells(mesh, tags == VtkTags::surface_cells);
  std::size_t numbers = 0;
  for (const auto& cell : cells.nodes)
    numbers += cell.size() + 1;
  std::string text = fmt::format(
      "# vtk DataFile Version 3.0\na wall\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n{}"
      "CELLS {} {}\n",
      mesh.nodes.size(), points_text(mesh), cells.nodes.size(), numbers);
  for (const auto& cell : cells.nodes)
    text += fmt::format("{} {}\n", cell.size(), fmt::join(cell, " "));
  text += fmt::format("CELL_TYPES {}\n{}\n", cells.types.size(), fmt::join(cells.types, "\n"));
  if (tags == VtkTags::surface_cells)
    text += fmt::format("CELL_DATA {}\nSCALARS side int 1\nLOOKUP_TABLE default\n{}\n",
                        cells.sides.size(), fmt::join(cells.sides, "\n"));
  text += fmt::format("POINT_DATA {}\nSCALARS infarct double 1\nLOOKUP_TABLE default\n{}\n",
                      mesh.nodes.size(), fmt::join(mesh.infarct, "\n"));
  for (int s = 0; s < 3 && tags == VtkTags::point_arrays; ++s)
    text += fmt::format("SCALARS {} int 1\nLOOKUP_TABLE default\n{}\n", names[s],
                        fmt::join(flags(mesh, s), "\n"));
  return text;
}

std::string vtu_text(const Mesh& mesh, VtkTags tags) {
  const VtkCells cells = vtk_cells(mesh, tags == VtkTags::surface_cells);
  const auto array = [](const char* type, const std::string& name, const std::string& values) {
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">\n{}\n</DataArray>\n",
                       type, name, values);
  };
  std::string connectivity;
  std::string offsets;
  std::size_t end = 0;
  for (const auto& cell : cells.nodes) {
    connectivity += fmt::format("{}\n", fmt::join(cell, " "));
    offsets += fmt::format("{}\n", end += cell.size());
  }
  std::string point_data =
      array("Float64", "infarct", fmt::format("{}", fmt::join(mesh.infarct, "\n")));
  for (int s = 0; s < 3 && tags == VtkTags::point_arrays; ++s)
    point_data += array("Int32", names[s], fmt::format("{}", fmt::join(flags(mesh, s), "\n")));
  std::string cell_data;
  if (tags == VtkTags::surface_cells)
    cell_data = array("Int32", "side", fmt::format("{}", fmt::join(cells.sides, "\n")));
  return fmt::format(
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n{}</DataArray>\n"
      "</Points>\n<Cells>\n{}{}{}</Cells>\n<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n"
      "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
      mesh.nodes.size(), cells.nodes.size(), points_text(mesh),
      array("Int64", "connectivity", connectivity), array("Int64", "offsets", offsets),
      array("UInt8", "types", fmt::format("{}", fmt::join(cells.types, "\n"))), point_data,
      cell_data);
}

std::string gmsh22_text(const Mesh& mesh, const std::vector<bool>& scar,
                        const std::function<int(int group)>& elementary) {
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{}$Nodes\n{}\n",
                                 physical_names, mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    text += fmt::format("{} {} {} {}\n", i + 1, mesh.nodes[i].x(), mesh.nodes[i].y(),
                        mesh.nodes[i].z());
  const auto elements = gmsh_elements(mesh, scar);
  text += fmt::format("$EndNodes\n$Elements\n{}\n", elements.size());
  for (const GmshElement& e : elements)
    text += fmt::format("{} {} 2 {} {} {}\n", e.number, e.type, e.entity,
                        elementary ? elementary(e.entity) : e.entity, from_one(e.nodes, " "));
  return text + "$EndElements\n";
}

std::string gmsh22_bytes(const Mesh& mesh, bool swapped) {
  std::string bytes = "$MeshFormat\n2.2 1 8\n";
  append(bytes, std::int32_t{1}, swapped);
  bytes +=
      "\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"endo\"\n2 2 \"epi\"\n2 3 \"base\"\n"
      "$EndPhysicalNames\n$Nodes\n" +
      std::to_string(mesh.nodes.size()) + "\n";
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    append(bytes, static_cast<std::int32_t>(a + 1), swapped);
    for (const double x : mesh.nodes[a])
      append(bytes, x, swapped);
  }
  const int faces = mesh.endo.size() + mesh.epi.size() + mesh.base.size();
  bytes += fmt::format("\n$EndNodes\n$Elements\n{}\n", faces + mesh.cell_count());
  std::int32_t number = 0;
  const auto block = [&](std::int32_t type, int count, int group, const auto& nodes_of) {
    for (const std::int32_t value : {type, count, 2})
      append(bytes, value, swapped);
    for (int i = 0; i < count; ++i) {
      for (const std::int32_t value : {++number, group, 1})
        append(bytes, value, swapped);
      for (const int node : nodes_of(i))
        append(bytes, static_cast<std::int32_t>(node + 1), swapped);
    }
  };
  const bool hexahedra = mesh.kind == CellKind::hexahedron;
  for (int s = 0; s < 3; ++s)
    block(hexahedra ? 3 : 2, sides(mesh)[s]->size(), s + 1,
          [&](int f) { return sides(mesh)[s]->face(f); });
  block(hexahedra ? 5 : 4, mesh.cell_count(), 7, [&](int c) { return mesh.cell(c); });
  return bytes + "\n$EndElements\n";
}

std::string gmsh41(const Mesh& mesh, GmshNumbers numbers, bool partitioned) {
  Gmsh41Writer file(numbers);
  put_entities(file, partitioned);
  put_nodes(file, mesh);
  put_elements(file, mesh);
  return std::move(file).text();
}

Quadratic quadratic(const Mesh& mesh) {
  Quadratic result{mesh.nodes, {}};
  std::map<std::pair<int, int>, int> middles;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    std::vector<int> nodes(mesh.cell(c).begin(), mesh.cell(c).end());
    for (const auto& [a, b] : mesh::cell_edges(mesh.kind)) {
      const std::pair<int, int> edge = std::minmax(mesh.cell(c)[a], mesh.cell(c)[b]);
      const auto [entry, added] = middles.emplace(edge, static_cast<int>(result.nodes.size()));
      if (added)
        result.nodes.push_back(0.5 * (mesh.nodes[edge.first] + mesh.nodes[edge.second]));
      nodes.push_back(entry->second);
    }
    result.cells.push_back(nodes);
  }
  return result;
}

std::string vtp_text(const Mesh& mesh, const Surface& side, int first) {
  const std::vector<int> nodes = mesh::surface_nodes(side);
  std::string points;
  std::string ids;
  std::map<int, int> place;
  for (const int node : nodes) {
    place[node] = static_cast<int>(place.size());
    points +=
        fmt::format("{} {} {}\n", mesh.nodes[node].x(), mesh.nodes[node].y(), mesh.nodes[node].z());
    ids += fmt::format("{}\n", node + first);
  }
  std::string connectivity;
  std::string offsets;
  for (int f = 0; f < side.size(); ++f) {
    for (const int node : side.face(f))
      connectivity += fmt::format("{} ", place.at(node));
    offsets += fmt::format("{}\n", (f + 1) * side.nodes_per_face);
  }
  const std::string numbers = fmt::format(
      "<PointData>\n<DataArray type=\"Int32\" Name=\"GlobalNodeID\" format=\"ascii\">\n{}"
      "</DataArray>\n</PointData>\n",
      ids);
  return fmt::format(
      "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n<PolyData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n{}<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" "
      "format=\"ascii\">\n{}</DataArray>\n</Points>\n<Polys>\n"
      "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n{}\n</DataArray>\n"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n{}</DataArray>\n</Polys>\n"
      "</Piece>\n</PolyData>\n</VTKFile>\n",
      nodes.size(), side.size(), first < 0 ? "" : numbers, points, connectivity, offsets);
}

std::string vtu_array(const std::string& name, const std::vector<Vec3>& vectors) {
  std::string text = fmt::format(
      "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"3\" format=\"ascii\">\n", name);
  for (const Vec3& v : vectors)
    text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
  return text + "</DataArray>\n";
}

std::vector<mesh::FaceKey> sorted_keys(const mesh::Surface& surface) {
  std::vector<mesh::FaceKey> keys;
  for (int f = 0; f < surface.size(); ++f)
    keys.push_back(mesh::face_key(surface.face(f)));
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos)
    throw std::invalid_argument("the text has no " + from);
  return text.replace(at, from.size(), to);
}

}  // namespace lv::test
