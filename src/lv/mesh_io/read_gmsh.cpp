#include "lv/mesh_io/read_gmsh.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/trial.hpp"
#include "lv/mesh_io/read_gmsh22.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <set>
#include <unordered_map>

namespace lv::mesh_io {
namespace {

using Tags = std::vector<std::size_t>;

/// Gmsh from its start to its end, silent.
class Gmsh {
 public:
  Gmsh() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::logger::start();
  }
  ~Gmsh() {
    gmsh::logger::stop();
    gmsh::finalize();
  }
  Gmsh(const Gmsh&) = delete;
  Gmsh& operator=(const Gmsh&) = delete;

  [[nodiscard]] static std::string first_error() {
    std::vector<std::string> log;
    gmsh::logger::get(log);
    for (const std::string& line : log)
      if (line.starts_with("Error: "))
        return line.substr(7);
    return {};
  }
};

/// The version of a file's format. Gmsh would run a file that it does not recognise as a script.
double format_of(const std::string& file) {
  check_encoding(file);
  std::ifstream stream(file);
  std::string header;
  double version = 0.0;
  stream >> header >> version;
  if (header != "$MeshFormat")
    throw InputError(fmt::format("{}:1", file), "is not a Gmsh mesh: $MeshFormat is missing",
                     "Export it from Gmsh as .msh, version 4.1 or 2.2");
  if (version != 2.2 && version != 4.1)
    throw InputError(fmt::format("{}:2", file),
                     fmt::format("has Gmsh's mesh format {}, which is not read", version),
                     "Export it as version 4.1 or 2.2");
  return version;
}

void open(const std::string& file) {
  try {
    gmsh::open(file);
  } catch (...) {  // Gmsh throws numbers or strings, by version; the log tells what happened
    throw InputError(file, fmt::format("cannot be read: {}", Gmsh::first_error()),
                     "The file seems to be truncated or damaged");
  }
  if (const std::string error = Gmsh::first_error(); !error.empty())
    throw InputError(file, fmt::format("cannot be read: {}", error),
                     "The file seems to be truncated or damaged");
}

/// Elements of one type.
struct Elements {
  int dimension = 0;
  int nodes_each = 0;
  int corners = 0;   ///< the first of the nodes
  std::string name;  ///< "Hexahedron 8"
  Tags tags, nodes;
};

std::vector<Elements> elements_of(int dimension, int entity) {
  std::vector<int> types;
  std::vector<Tags> tags;
  std::vector<Tags> nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
  std::vector<Elements> result;
  for (std::size_t i = 0; i < types.size(); ++i) {
    Elements e{0, 0, 0, "", tags[i], nodes[i]};
    int order = 0;
    std::vector<double> places;
    gmsh::model::mesh::getElementProperties(types[i], e.name, e.dimension, order, e.nodes_each,
                                            places, e.corners);
    result.push_back(std::move(e));
  }
  return result;
}

/// The order of ascending tags: Gmsh gives nodes and elements entity by entity.
std::vector<std::size_t> ascending(const Tags& tags) {
  std::vector<std::size_t> order(tags.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
  return order;
}

/// The place of each node's tag in our list.
class NodeIndex {
 public:
  explicit NodeIndex(ForeignMesh& foreign) : file_(foreign.files.front()) {
    Tags tags;
    std::vector<double> coordinates;
    std::vector<double> parametric;
    gmsh::model::mesh::getNodes(tags, coordinates, parametric, -1, -1, false, false);
    for (const std::size_t i : ascending(tags)) {
      if (!index_.emplace(tags[i], static_cast<int>(foreign.mesh.nodes.size())).second)
        continue;
      foreign.mesh.nodes.emplace_back(&coordinates[3 * i]);
      foreign.node_numbers.push_back(static_cast<std::int64_t>(tags[i]));
    }
  }

  [[nodiscard]] int operator()(std::size_t tag) const {
    const auto found = index_.find(tag);
    if (found == index_.end())
      throw InputError(file_, fmt::format("an element uses node {}, which is not defined", tag),
                       "The file seems to be truncated or damaged");
    return found->second;
  }

 private:
  std::string file_;
  std::unordered_map<std::size_t, int> index_;
};

void add_cells(ForeignMesh& foreign, const NodeIndex& index) {
  const auto volumes = elements_of(3, -1);
  std::map<std::string, int> shapes;
  for (const Elements& e : volumes)
    shapes[gmsh_shape(e.name)] += static_cast<int>(e.tags.size());
  foreign.mesh.kind = only_kind(foreign.files.front(), shapes);
  int quadratic = 0;
  for (const Elements& cells : volumes) {
    quadratic += cells.nodes_each > cells.corners ? static_cast<int>(cells.tags.size()) : 0;
    for (const std::size_t i : ascending(cells.tags)) {
      for (int a = 0; a < cells.corners; ++a)
        foreign.mesh.cells.push_back(index(cells.nodes[i * cells.nodes_each + a]));
      foreign.cell_numbers.push_back(static_cast<std::int64_t>(cells.tags[i]));
    }
  }
  foreign.note_quadratic(quadratic);
}

/// The entities of the physical group of that name or number. `what` names such a group.
std::vector<int> entities_of_group(const std::string& file, int dimension, const char* what,
                                   const std::string& tag) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, dimension);
  std::vector<std::string> tags;
  for (const auto& group : groups) {
    const std::string number = fmt::format("{}", group.second);
    std::string name;
    gmsh::model::getPhysicalName(dimension, group.second, name);
    if (tag == name || tag == number) {
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(dimension, group.second, entities);
      return entities;
    }
    tags.push_back(name.empty() ? number : name);
  }
  fail_missing_tag(file, what, tag, tags);
}

ForeignSide find_side(const std::string& file, const std::string& tag, const NodeIndex& index) {
  ForeignSide side;
  for (const int entity : entities_of_group(file, 2, "physical surface", tag)) {
    for (const Elements& e : elements_of(2, entity)) {
      if (e.corners != 3 && e.corners != 4)
        continue;
      for (std::size_t first = 0; first < e.nodes.size(); first += e.nodes_each) {
        std::vector<int> face;
        for (int a = 0; a < e.corners; ++a)
          face.push_back(index(e.nodes[first + a]));
        side.faces.push_back(mesh::face_key(face));
      }
    }
  }
  return side;
}

/// Marks the cells of a physical volume.
std::vector<bool> find_infarcted(const ForeignMesh& foreign, const std::string& tag) {
  std::set<std::size_t> members;
  for (const int entity : entities_of_group(foreign.files.front(), 3, "physical volume", tag))
    for (const Elements& e : elements_of(3, entity))
      members.insert(e.tags.begin(), e.tags.end());
  std::vector<bool> infarcted;
  for (const std::int64_t number : foreign.cell_numbers)
    infarcted.push_back(members.contains(static_cast<std::size_t>(number)));
  return infarcted;
}

ForeignMesh read_gmsh_mesh(const mesh::ImportParameters& parameters) {
  const Gmsh session;
  open(parameters.file);
  ForeignMesh foreign;
  foreign.files = {parameters.file};
  const NodeIndex index(foreign);
  add_cells(foreign, index);
  if (parameters.sides == mesh::SideSource::tags)
    foreign.sides = find_sides(
        parameters, [&](const std::string& tag) { return find_side(parameters.file, tag, index); });
  if (!parameters.infarct_set.empty())
    foreign.infarcted = find_infarcted(foreign, parameters.infarct_set);
  std::vector<int> fields;
  gmsh::view::getTags(fields);
  foreign.note_fields(!fields.empty());
  return foreign;
}

}  // namespace

ForeignMesh read_gmsh(const mesh::ImportParameters& parameters) {
  if (format_of(parameters.file) == 2.2)
    return read_gmsh22(parameters);
  check_survives(parameters.file, [&] { static_cast<void>(read_gmsh_mesh(parameters)); });
  return read_gmsh_mesh(parameters);
}

}  // namespace lv::mesh_io
