#include "lv/mesh_io/foreign_mesh.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/nearest.hpp"
#include "lv/mesh/cell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lv::mesh_io {
namespace {

constexpr std::size_t tags_shown = 30;

std::string list(std::vector<std::string> names) {
  const std::size_t all = names.size();
  if (all <= tags_shown)
    return fmt::format("{}", fmt::join(names, ", "));
  names.resize(tags_shown);
  return fmt::format("{} and {} more", fmt::join(names, ", "), all - tags_shown);
}

}  // namespace

void ForeignMesh::note_quadratic(int elements) {
  if (elements > 0)
    notes.push_back(fmt::format(
        "{} quadratic elements were read by their corners: curved edges became straight",
        elements));
}

void ForeignMesh::note_fields(bool has_fields) {
  if (has_fields)
    notes.emplace_back(
        "the file's data at nodes or in elements is not read: fibres follow the rule of [fibres], "
        "or come with a .vtu file");
}

std::string ForeignMesh::where_node(int node) const {
  return node_lines.empty() ? files.front() : format_line(files, node_lines[node]);
}

std::string ForeignMesh::where_cell(int cell) const {
  return cell_lines.empty() ? files.front() : format_line(files, cell_lines[cell]);
}

std::string ForeignMesh::name_node(int node) const {
  return fmt::format("node {} at {}", node_numbers[node], format_place(mesh.nodes[node]));
}

std::string ForeignMesh::name_cell(int cell) const {
  return fmt::format("element {} at {}", cell_numbers[cell],
                     format_place(mesh::cell_centre(mesh, cell)));
}

std::string ForeignMesh::format_place(const Vec3& place) const {
  const Vec3 x = place.cwiseQuotient(scale);
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", x.x(), x.y(), x.z());
}

std::string format_line(const std::vector<std::string>& files, FileLine line) {
  return fmt::format("{}:{}", files[line.file], line.number);
}

bool names_file(const std::string& name) {
  const std::string ending = ending_of(name);
  return ending == ".vtp" || ending == ".vtk" || ending == ".vtu";
}

std::string gmsh_shape(const std::string& name) {
  return name.starts_with("Hexahedron ")    ? hexahedron_name
         : name.starts_with("Tetrahedron ") ? tetrahedron_name
                                            : name;
}

std::array<std::string, 3> side_tags(const mesh::ImportParameters& parameters) {
  return {parameters.endo, parameters.epi, parameters.base};
}

mesh::CellKind only_kind(const std::string& file, const std::map<std::string, int>& counts) {
  if (counts.empty())
    throw InputError(file, "holds no volume cells",
                     "Export the wall as hexahedra or tetrahedra, not its surfaces alone");
  if (counts.size() == 1 && counts.begin()->first == hexahedron_name)
    return mesh::CellKind::hexahedron;
  if (counts.size() == 1 && counts.begin()->first == tetrahedron_name)
    return mesh::CellKind::tetrahedron;
  std::vector<std::string> found;
  for (const auto& [shape, count] : counts)
    found.push_back(fmt::format("{} of shape {}", count, shape));
  throw InputError(file,
                   fmt::format("holds volume cells that cannot be used{}: {}",
                               counts.size() > 1 ? " together" : "", fmt::join(found, ", ")),
                   "Mesh the whole wall with hexahedra, or the whole wall with tetrahedra");
}

void fail_missing_tag(const std::string& file, const std::string& what, const std::string& tag,
                      const std::vector<std::string>& tags) {
  const std::string nearest = nearest_name(tag, tags);
  const std::string suggestion =
      nearest.empty() ? "Name one of them" : fmt::format("Did you mean \"{}\"?", nearest);
  if (tags.empty())
    throw InputError(
        file, fmt::format("has no {} \"{}\", nor any other", what, tag),
        "Tag it in the program that made the mesh; sides can also be found by geometry");
  throw InputError(file, fmt::format("has no {} \"{}\"; it has {}", what, tag, list(tags)),
                   suggestion);
}

}  // namespace lv::mesh_io
