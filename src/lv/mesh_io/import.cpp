#include "lv/mesh_io/import.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/formats.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh/transmural.hpp"
#include "lv/mesh_io/foreign_fibres.hpp"
#include "lv/mesh_io/foreign_mesh.hpp"
#include "lv/mesh_io/notches.hpp"
#include "lv/mesh_io/read_abaqus.hpp"
#include "lv/mesh_io/read_gmsh.hpp"
#include "lv/mesh_io/read_vtk.hpp"
#include "lv/mesh_io/sides.hpp"
#include "lv/mesh_io/stated_space.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

namespace lv::mesh_io {
namespace {

constexpr double same_place = 1e-5;  ///< relative to the wall's extent

ForeignMesh read(const mesh::ImportParameters& parameters) {
  const std::filesystem::path path(parameters.file);
  require_readable(path, "Check the name of the mesh");
  const std::string ending = ending_of(path);
  if (ending == ".vtk" || ending == ".vtu")
    return read_vtk(parameters);
  if (ending != ".inp" && ending != ".msh")
    throw InputError(parameters.file, fmt::format("has the unknown ending \"{}\"", ending),
                     fmt::format("Meshes are read from {}", formats::meshes));
  if (!parameters.fibres.empty())
    throw InputError(parameters.file, "is no file that fibres are read from",
                     "Convert it to .vtu with the fibres as an array, or leave anatomy.mesh.fibres "
                     "out: they follow the rule of [fibres]");
  ForeignMesh foreign = ending == ".inp" ? read_abaqus(parameters) : read_gmsh(parameters);
  foreign.in_ras = says_ras(parameters.file);
  return foreign;
}

constexpr int dropped = -2;  ///< a node that no cell has

/// Of each node the number that it gets, in order, or `dropped` where no cell uses it.
std::vector<int> places_of_used(const mesh::Mesh& mesh) {
  std::vector<int> place(mesh.nodes.size(), dropped);
  for (const int node : mesh.cells)
    place[node] = 0;
  int kept = 0;
  for (int& at : place)
    if (at != dropped)
      at = kept++;
  return place;
}

/// With nodes at other places.
void renumber(ForeignSide& side, const std::vector<int>& place) {
  for (mesh::FaceKey& key : side.faces) {
    for (int& node : key)
      node = node < 0 ? node : place[node];
    key = mesh::face_key({key.data(), key[3] < 0 ? std::size_t{3} : std::size_t{4}});
  }
  for (int& node : side.nodes)
    node = place[node];
  std::erase(side.nodes, dropped);
}

/// Drops the nodes that no cell uses; whatever referred to them then refers to a node that no cell
/// has.
void drop_unused_nodes(ForeignMesh& foreign) {
  mesh::Mesh& mesh = foreign.mesh;
  const std::vector<int> place = places_of_used(mesh);
  const auto keep = [&](auto& values) {
    std::size_t kept = 0;
    for (std::size_t old = 0; old < values.size(); ++old)
      if (place[old] != dropped)
        values[kept++] = values[old];
    values.resize(kept);
  };
  keep(mesh.nodes);
  keep(mesh.infarct);
  if (mesh.fibres.given.at == mesh::GivenFibres::At::nodes) {
    keep(mesh.fibres.given.f0);
    keep(mesh.fibres.given.s0);
  }
  keep(foreign.node_numbers);
  keep(foreign.node_lines);
  for (int& node : mesh.cells)
    node = place[node];
  for (ForeignSide& side : foreign.sides)
    renumber(side, place);
  if (mesh.nodes.size() < place.size())
    foreign.notes.push_back(fmt::format("{} nodes that no element uses were dropped",
                                        place.size() - mesh.nodes.size()));
}

void check_coordinates(const ForeignMesh& foreign) {
  for (int node = 0; node < static_cast<int>(foreign.mesh.nodes.size()); ++node)
    if (!foreign.mesh.nodes[node].allFinite())
      throw InputError(foreign.where_node(node),
                       fmt::format("{} is not a place", foreign.name_node(node)),
                       "Repair the coordinates in the file");
}

/// From the file's unit and space to millimetres in LPS.
void scale(ForeignMesh& foreign, double unit) {
  const Vec3 signs = foreign.in_ras ? ras_to_lps : Vec3(Vec3::Ones());
  foreign.scale = unit * signs;
  for (Vec3& X : foreign.mesh.nodes)
    X = X.cwiseProduct(foreign.scale);
  for (std::vector<Vec3>* directions :
       {&foreign.mesh.fibres.given.f0, &foreign.mesh.fibres.given.s0})
    for (Vec3& direction : *directions)
      direction = direction.cwiseProduct(signs);
  if (foreign.in_ras)
    foreign.notes.emplace_back("the file says SPACE=RAS: x and y change their signs");
}

double extent(const std::vector<Vec3>& nodes) {
  Vec3 lowest = nodes.front();
  Vec3 highest = nodes.front();
  for (const Vec3& X : nodes) {
    lowest = lowest.cwiseMin(X);
    highest = highest.cwiseMax(X);
  }
  return (highest - lowest).maxCoeff();
}

void check_extent(const ForeignMesh& foreign, const mesh::ImportParameters& p) {
  struct Unit {
    const char* name;
    double mm;
  };
  constexpr std::array<Unit, 4> units{{{"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"um", 0.001}}};
  const double found = extent(foreign.mesh.nodes);
  if (found >= p.shortest && found <= p.longest)
    return;
  std::string remedy = "Check the mesh and its unit";
  for (const Unit& unit : units) {
    const double in_unit = found / p.unit * unit.mm;
    if (in_unit >= p.shortest && in_unit <= p.longest) {
      remedy = fmt::format(
          "The file's unit looks like {}: set anatomy.mesh.length_unit, with the line "
          "length_unit = \"{} mm\" under [anatomy.mesh]",
          unit.name, unit.mm);
      break;
    }
  }
  throw InputError(p.file,
                   fmt::format("with a unit of {} mm the wall measures {:.3g} mm; from a ventricle "
                               "{:.3g} to {:.3g} mm are expected",
                               p.unit, found, p.shortest, p.longest),
                   remedy);
}

void check_infarct(ForeignMesh& foreign) {
  mesh::Mesh& mesh = foreign.mesh;
  for (int node = 0; node < static_cast<int>(mesh.infarct.size()); ++node)
    if (!(mesh.infarct[node] >= 0.0 && mesh.infarct[node] <= 1.0))
      throw InputError(
          foreign.where_node(node),
          fmt::format("the infarct field is {} at {}", mesh.infarct[node], foreign.name_node(node)),
          "It must lie between 0 (healthy) and 1 (infarcted)");
  mesh.infarct.resize(mesh.nodes.size(), 0.0);
}

void check_collapsed(const ForeignMesh& foreign) {
  int collapsed = 0;
  int first = 0;
  for (int c = foreign.mesh.cell_count() - 1; c >= 0; --c) {
    std::vector<int> nodes(foreign.mesh.cell(c).begin(), foreign.mesh.cell(c).end());
    std::sort(nodes.begin(), nodes.end());
    if (std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end())
      continue;
    ++collapsed;
    first = c;
  }
  if (collapsed > 0)
    throw InputError(foreign.where_cell(first),
                     fmt::format("{} elements use one node twice, the first is {}", collapsed,
                                 foreign.name_cell(first)),
                     "Wedges written as collapsed hexahedra cannot be used: remesh the apex");
}

struct Inverted {
  int count = 0;
  int worst = 0;
  double jacobian = 0.0;
};

Inverted find_inverted(const mesh::Mesh& mesh) {
  Inverted inverted;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const double jacobian = mesh::smallest_jacobian(mesh, c);
    if (jacobian > 0.0)
      continue;
    if (inverted.count++ == 0 || jacobian < inverted.jacobian) {
      inverted.worst = c;
      inverted.jacobian = jacobian;
    }
  }
  return inverted;
}

void check_inverted(const ForeignMesh& foreign) {
  const Inverted inverted = find_inverted(foreign.mesh);
  const int cells = foreign.mesh.cell_count();
  if (inverted.count > 0)
    throw InputError(
        foreign.where_cell(inverted.worst),
        fmt::format("{} of {} elements are inverted or flat; the worst is {} with a Jacobian of "
                    "{:.3g} mm^3",
                    inverted.count, cells, foreign.name_cell(inverted.worst), inverted.jacobian),
        2 * inverted.count > cells ? "Are the nodes in the order of the file's format?"
                                   : "Repair these elements in the program that made the mesh");
}

/// Mirrors every cell.
void mirror(mesh::Mesh& mesh) {
  const std::vector<int> hexahedron{0, 3, 2, 1, 4, 7, 6, 5};
  const std::vector<int> tetrahedron{0, 2, 1, 3};
  const auto& order = mesh.kind == mesh::CellKind::hexahedron ? hexahedron : tetrahedron;
  const std::vector<int> old = mesh.cells;
  for (std::size_t i = 0; i < old.size(); ++i)
    mesh.cells[i] = old[i - i % order.size() + order[i % order.size()]];
}

void repair_order(ForeignMesh& foreign) {
  if (find_inverted(foreign.mesh).count < foreign.mesh.cell_count())
    return;
  mesh::Mesh mirrored = foreign.mesh;
  mirror(mirrored);
  if (find_inverted(mirrored).count > 0)
    return;
  foreign.mesh = std::move(mirrored);
  foreign.notes.emplace_back("all elements were inverted: the order of their nodes was mirrored");
}

struct Pairs {
  int count = 0;
  std::array<int, 2> first{};
};

/// Different nodes in the same place. Nodes are compared along the order of their projections on
/// one direction, in which hardly any two are close by chance.
Pairs coincident_nodes(const std::vector<Vec3>& nodes, double tolerance) {
  const Vec3 direction = Vec3(0.5345, 0.6212, 0.5731).normalized();
  std::vector<int> order(nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> along;
  for (const Vec3& X : nodes)
    along.push_back(direction.dot(X));
  std::sort(order.begin(), order.end(), [&](int a, int b) { return along[a] < along[b]; });
  Pairs pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      if (along[order[j]] - along[order[i]] > tolerance)
        break;
      if ((nodes[order[j]] - nodes[order[i]]).norm() > tolerance)
        continue;
      if (pairs.count++ == 0)
        std::tie(pairs.first[0], pairs.first[1]) = std::minmax(order[i], order[j]);
    }
  }
  return pairs;
}

void check_connected(const ForeignMesh& foreign) {
  const mesh::Mesh& mesh = foreign.mesh;
  const int parts = mesh::count_parts(mesh::cell_parts(mesh));
  const Pairs pairs = coincident_nodes(mesh.nodes, same_place * extent(mesh.nodes));
  const std::string consequence =
      parts == 1 ? "leaves cracks in the wall"
                 : fmt::format("breaks the wall into {} unconnected parts", parts);
  if (pairs.count > 0)
    throw InputError(
        foreign.where_node(pairs.first[0]),
        fmt::format("{} pairs of nodes lie in one place, which {}; the first are {} and node {}",
                    pairs.count, consequence, foreign.name_node(pairs.first[0]),
                    foreign.node_numbers[pairs.first[1]]),
        "Merge coincident nodes in the program that made the mesh");
  if (parts > 1)
    throw InputError(foreign.files.front(),
                     fmt::format("the wall consists of {} unconnected parts", parts),
                     "Write the elements of the left ventricle's wall alone");
  const auto crowded = mesh::crowded_faces(mesh);
  if (!crowded.empty())
    throw InputError(
        foreign.files.front(),
        fmt::format("{} faces belong to more than two elements, the first at {}", crowded.size(),
                    foreign.format_place(mesh.nodes[crowded.front()[0]])),
        "Remove elements that lie on one another");
}

/// Moves the base's nodes onto their plane.
void flatten_base(ForeignMesh& foreign, const mesh::Surface& base, const mesh::Plane& plane,
                  double tolerance) {
  double furthest = 0.0;
  int worst = 0;
  for (const int node : mesh::surface_nodes(base)) {
    const double height = std::abs(plane.height(foreign.mesh.nodes[node]));
    if (height > furthest) {
      furthest = height;
      worst = node;
    }
  }
  if (furthest > tolerance)
    throw InputError(
        foreign.where_node(worst),
        fmt::format("the base is not plane: {} lies {:.3g} mm from its best-fit plane",
                    foreign.name_node(worst), furthest),
        fmt::format("Cut the wall along a plane, or raise anatomy.mesh.base_tolerance, {:.3g} mm",
                    tolerance));
  for (const int node : mesh::surface_nodes(base)) {
    Vec3& X = foreign.mesh.nodes[node];
    X -= plane.height(X) * plane.normal;
  }
  if (furthest > 1e-3)
    foreign.notes.push_back(
        fmt::format("the base was made plane, which moved its nodes by up to {:.3g} mm", furthest));
}

/// A sentence for each side of the wall from which elements seem to be missing.
std::vector<std::string> notch_warnings(const ForeignMesh& foreign, const Sides& sides) {
  std::vector<std::string> warnings;
  const auto check = [&](const mesh::Surface& side, Bulge bulge, const char* name) {
    const std::vector<Vec3> places = notches(foreign.mesh.nodes, side, bulge);
    if (places.empty())
      return;
    const std::string where = foreign.format_place(places.front());
    warnings.push_back(fmt::format(
        "the {} has {} as a missing element leaves it: no wall turns so sharply both ways from one "
        "face to the next. Look at the mesh there: volumes and stresses are those of the wall with "
        "it",
        name,
        places.size() == 1
            ? fmt::format("a notch near {},", where)
            : fmt::format("{} notches, the first near {}, each", places.size(), where)));
  };
  check(sides[0], Bulge::inwards, "endocardium");
  check(sides[1], Bulge::outwards, "epicardium");
  return warnings;
}

/// The centre of the endocardium's edge, every piece of which counts by its length.
Vec3 edge_centre(const mesh::Mesh& mesh, const mesh::Surface& endo) {
  Vec3 moment = Vec3::Zero();
  double length = 0.0;
  for (const auto& [a, b] : mesh::boundary_edges(endo)) {
    const double piece = (mesh.nodes[b] - mesh.nodes[a]).norm();
    moment += piece * 0.5 * (mesh.nodes[a] + mesh.nodes[b]);
    length += piece;
  }
  return moment / length;
}

geometry::Frame model_frame(const mesh::Mesh& mesh, const mesh::Surface& endo, const Vec3& up) {
  const Vec3 reference = std::abs(up.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 x = (reference - reference.dot(up) * up).normalized();
  geometry::Frame frame;
  frame.axes << x, up.cross(x), up;
  frame.origin = edge_centre(mesh, endo);
  return frame;
}

void check_cells(ForeignMesh& foreign) {
  check_collapsed(foreign);
  repair_order(foreign);
  check_inverted(foreign);
  check_connected(foreign);
}

ImportedMesh to_model(ForeignMesh&& foreign, const Sides& sides, const mesh::Plane& base) {
  ImportedMesh imported;
  imported.frame = model_frame(foreign.mesh, sides[0], base.normal);
  imported.mesh = std::move(foreign.mesh);
  for (Vec3& X : imported.mesh.nodes)
    X = imported.frame.to_model(X);
  for (std::vector<Vec3>* directions :
       {&imported.mesh.fibres.given.f0, &imported.mesh.fibres.given.s0})
    for (Vec3& direction : *directions)
      direction = imported.frame.axes.transpose() * direction;
  std::tie(imported.mesh.endo, imported.mesh.epi, imported.mesh.base) =
      std::tie(sides[0], sides[1], sides[2]);
  for (const int node : sides[2].nodes)
    imported.mesh.nodes[node].z() = 0.0;  // rounding off
  imported.mesh.transmural = mesh::transmural_by_distance(imported.mesh);
  imported.infarcted = std::move(foreign.infarcted);
  imported.unread = std::move(foreign.unread);
  imported.node_numbers = std::move(foreign.node_numbers);
  imported.cell_numbers = std::move(foreign.cell_numbers);
  imported.notes = std::move(foreign.notes);
  return imported;
}

}  // namespace

ImportedMesh import_mesh(const mesh::ImportParameters& parameters) {
  ForeignMesh foreign = read(parameters);
  drop_unused_nodes(foreign);
  check_coordinates(foreign);
  scale(foreign, parameters.unit);
  make_orthonormal(foreign);
  check_extent(foreign, parameters);
  check_infarct(foreign);
  check_cells(foreign);
  const Sides sides = parameters.sides == mesh::SideSource::tags
                          ? tagged_sides(foreign)
                          : sides_by_geometry(foreign, parameters.base_tolerance);
  check_sides(foreign, sides);
  const mesh::Plane base = outward_plane(foreign, sides[2]);
  flatten_base(foreign, sides[2], base, parameters.base_tolerance);
  check_inverted(foreign);
  std::vector<std::string> warnings = notch_warnings(foreign, sides);
  ImportedMesh imported = to_model(std::move(foreign), sides, base);
  imported.warnings = std::move(warnings);
  return imported;
}

}  // namespace lv::mesh_io
