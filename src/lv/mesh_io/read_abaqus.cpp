#include "lv/mesh_io/read_abaqus.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/cell.hpp"
#include "lv/mesh_io/abaqus_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

namespace lv::mesh_io {
namespace {

using Number = AbaqusModel::Number;
using Use = AbaqusElementType::Use;

std::vector<int> nodes_of(const AbaqusModel& model, const AbaqusModel::Element& element) {
  std::vector<int> nodes;
  for (const Number number : element.nodes) {
    const auto found = model.node_index.find(number);
    if (found == model.node_index.end())
      model.fail(
          element.at,
          fmt::format("element {} uses node {}, which is not defined", element.number, number),
          "The list of nodes seems to be truncated");
    nodes.push_back(found->second);
  }
  return nodes;
}

ForeignMesh to_mesh(const AbaqusModel& model) {
  ForeignMesh foreign;
  foreign.files = model.files;
  foreign.notes = model.notes;
  foreign.note_quadratic(model.quadratic);
  foreign.mesh.kind = only_kind(model.files.front(), model.volume_shapes);
  for (const AbaqusModel::Node& node : model.nodes) {
    foreign.mesh.nodes.push_back(node.X);
    foreign.node_numbers.push_back(node.number);
    foreign.node_lines.push_back(node.at);
  }
  for (const AbaqusModel::Element& element : model.elements) {
    if (element.type.use != Use::volume)
      continue;
    for (const int node : nodes_of(model, element))
      foreign.mesh.cells.push_back(node);
    foreign.cell_numbers.push_back(element.number);
    foreign.cell_lines.push_back(element.at);
  }
  return foreign;
}

ForeignSide side_of_nodes(const AbaqusModel& model, const std::vector<Number>& numbers) {
  ForeignSide side;
  for (const Number number : numbers)
    if (const auto found = model.node_index.find(number); found != model.node_index.end())
      side.nodes.push_back(found->second);
  return side;
}

/// Face Sk of a volume element is face k of cell_faces: ABAQUS numbers them alike.
mesh::FaceKey labelled_face(const AbaqusModel& model, const AbaqusModel::Element& element,
                            const AbaqusModel::SurfaceEntry& entry) {
  const std::vector<int> nodes = nodes_of(model, element);
  if (element.type.use == Use::surface)
    return mesh::face_key(nodes);
  const auto faces = mesh::cell_faces(nodes.size() == 8 ? mesh::CellKind::hexahedron
                                                        : mesh::CellKind::tetrahedron);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (entry.label != fmt::format("S{}", k + 1))
      continue;
    std::vector<int> face;
    for (const int a : faces[k])
      if (a >= 0)
        face.push_back(nodes[a]);
    return mesh::face_key(face);
  }
  model.fail(entry.at,
             fmt::format("\"{}\" is not a face label of element {}", entry.label, element.number),
             fmt::format("Use S1 to S{}", faces.size()));
}

ForeignSide side_of_surface(const AbaqusModel& model, const AbaqusModel::Surface& surface) {
  ForeignSide side;
  for (const AbaqusModel::SurfaceEntry& entry : surface.entries) {
    if (surface.of_nodes) {
      const auto part =
          side_of_nodes(model, model.members(model.node_sets, entry.target, entry.at));
      side.nodes.insert(side.nodes.end(), part.nodes.begin(), part.nodes.end());
      continue;
    }
    for (const Number number : model.members(model.element_sets, entry.target, entry.at)) {
      const auto found = model.element_index.find(number);
      if (found == model.element_index.end())
        model.fail(entry.at, fmt::format("element {} of the surface is not defined", number),
                   "The list of elements seems to be truncated");
      side.faces.push_back(labelled_face(model, model.elements[found->second], entry));
    }
  }
  return side;
}

ForeignSide side_of_elements(const AbaqusModel& model, const std::string& tag,
                             const std::vector<Number>& numbers) {
  ForeignSide side;
  for (const Number number : numbers) {
    const auto found = model.element_index.find(number);
    if (found == model.element_index.end() ||
        model.elements[found->second].type.use != Use::surface)
      throw InputError(
          model.files.front(),
          fmt::format("*Elset \"{}\" holds element {}, which is no surface element", tag, number),
          "Name a *Surface with face labels, a set of shell or membrane elements, or an *Nset");
    side.faces.push_back(mesh::face_key(nodes_of(model, model.elements[found->second])));
  }
  return side;
}

std::vector<std::string> all_tags(const AbaqusModel& model) {
  std::set<std::string> tags;
  for (const auto& [name, surface] : model.surfaces)
    tags.insert(name);
  for (const AbaqusModel::Sets& sets : {model.element_sets, model.node_sets})
    for (const auto& [name, set] : sets)
      tags.insert(name);
  return {tags.begin(), tags.end()};
}

/// A surface before a set of nodes before a set of elements: pre-processors write a set of nodes
/// and one of volume elements under the same name.
ForeignSide find_side(const AbaqusModel& model, const std::string& tag) {
  const std::string name = upper_case(tag);
  if (const auto found = model.surfaces.find(name); found != model.surfaces.end())
    return side_of_surface(model, found->second);
  if (const auto found = model.node_sets.find(name); found != model.node_sets.end())
    return side_of_nodes(model, found->second);
  if (const auto found = model.element_sets.find(name); found != model.element_sets.end())
    return side_of_elements(model, tag, found->second);
  fail_missing_tag(model.files.front(), "*Surface, *Elset or *Nset", tag, all_tags(model));
}

/// The volume elements among those numbers.
std::vector<bool> volume_members(const AbaqusModel& model, const std::vector<Number>& numbers) {
  const std::set<Number> members(numbers.begin(), numbers.end());
  std::vector<bool> marked;
  for (const AbaqusModel::Element& element : model.elements)
    if (element.type.use == Use::volume)
      marked.push_back(members.contains(element.number));
  return marked;
}

/// Marks the volume elements of a set.
std::vector<bool> find_infarcted(const AbaqusModel& model, const std::string& set) {
  const auto found = model.element_sets.find(upper_case(set));
  if (found == model.element_sets.end()) {
    std::vector<std::string> names;
    for (const auto& [name, members] : model.element_sets)
      names.push_back(name);
    fail_missing_tag(model.files.front(), "*Elset", set, names);
  }
  return volume_members(model, found->second);
}

/// The first set that is called as an infarct is and holds elements of the wall.
std::optional<UnreadInfarct> unread_infarct(const AbaqusModel& model) {
  for (const auto& [name, numbers] : model.element_sets) {
    if (!is_infarct_name(name))
      continue;
    const std::vector<bool> marked = volume_members(model, numbers);
    if (std::find(marked.begin(), marked.end(), true) != marked.end())
      return UnreadInfarct{name};
  }
  return {};
}

}  // namespace

ForeignMesh read_abaqus(const mesh::ImportParameters& parameters) {
  const AbaqusModel model = read_abaqus_model(parameters.file);
  ForeignMesh foreign = to_mesh(model);
  if (parameters.sides == mesh::SideSource::tags)
    foreign.sides =
        find_sides(parameters, [&](const std::string& tag) { return find_side(model, tag); });
  if (!parameters.infarct_set.empty())
    foreign.infarcted = find_infarcted(model, parameters.infarct_set);
  else
    foreign.unread = unread_infarct(model);
  return foreign;
}

}  // namespace lv::mesh_io
