#include "lv/mesh_io/read_gmsh.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh_io/gmsh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace lv::mesh_io {
namespace {

using Element = GmshFile::Element;

/// Volume elements on the same nodes with different groups become one with all of them. How many
/// went.
std::size_t merge(std::vector<Element>& elements) {
  std::map<std::vector<std::int64_t>, std::size_t> first;
  std::vector<Element> merged;
  for (Element& element : elements) {
    std::vector<std::int64_t> key = element.corners;
    std::sort(key.begin(), key.end());
    const auto [entry, added] = first.emplace(std::move(key), merged.size());
    std::set<int>& groups = added ? element.groups : merged[entry->second].groups;
    const std::size_t before = groups.size();
    groups.insert(element.groups.begin(), element.groups.end());
    if (added || groups.size() == before)
      merged.push_back(std::move(element));
  }
  elements.swap(merged);
  return merged.size() - elements.size();
}

class Reader {
 public:
  explicit Reader(const mesh::ImportParameters& parameters)
      : parameters_(parameters), file_(read_gmsh_file(parameters.file)) {
    foreign_.files = {parameters.file};
    for (Element& element : file_.elements)
      if (element.shape.dimension == 3)
        cells_.push_back(std::move(element));
    if (const std::size_t gone = merge(cells_); gone > 0)
      foreign_.notes.push_back(fmt::format(
          "{} elements that stand in the file once for each of their groups were taken once",
          gone));
  }

  ForeignMesh read() {
    add_nodes();
    add_cells();
    if (parameters_.sides == mesh::SideSource::tags)
      foreign_.sides =
          find_sides(parameters_, [this](const std::string& tag) { return find_side(tag); });
    if (!parameters_.infarct_set.empty())
      foreign_.infarcted = find_infarcted(parameters_.infarct_set);
    else
      foreign_.unread = unread_infarct();
    foreign_.note_fields(file_.has_fields);
    return std::move(foreign_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& what) const {
    throw InputError(line == 0 ? parameters_.file : format_line(foreign_.files, {0, line}), what,
                     "The file seems to be truncated or damaged");
  }

  void add_nodes() {
    for (const GmshFile::Node& node : file_.nodes) {
      if (!index_.emplace(node.number, static_cast<int>(foreign_.mesh.nodes.size())).second)
        fail(node.line, fmt::format("node {} is defined a second time", node.number));
      foreign_.mesh.nodes.push_back(node.X);
      foreign_.node_numbers.push_back(node.number);
      if (node.line > 0)
        foreign_.node_lines.push_back({0, node.line});
    }
  }

  void add_cells() {
    std::map<std::string, int> shapes;
    for (const Element& cell : cells_)
      ++shapes[gmsh_shape(cell.shape.name)];
    foreign_.mesh.kind = only_kind(parameters_.file, shapes);
    int quadratic = 0;
    for (const Element& cell : cells_) {
      const std::vector<int> corners = nodes_of(cell);
      foreign_.mesh.cells.insert(foreign_.mesh.cells.end(), corners.begin(), corners.end());
      foreign_.cell_numbers.push_back(cell.number);
      if (cell.line > 0)
        foreign_.cell_lines.push_back({0, cell.line});
      quadratic += cell.shape.nodes > cell.shape.corners ? 1 : 0;
    }
    foreign_.note_quadratic(quadratic);
  }

  [[nodiscard]] std::vector<int> nodes_of(const Element& element) const {
    std::vector<int> nodes;
    for (const std::int64_t number : element.corners) {
      const auto found = index_.find(number);
      if (found == index_.end())
        fail(element.line,
             fmt::format("element {} uses node {}, which is not defined", element.number, number));
      nodes.push_back(found->second);
    }
    return nodes;
  }

  /// The groups of that name, or the one of that number.
  [[nodiscard]] std::set<int> groups_called(const std::vector<Element>& elements, int dimension,
                                            const char* what, const std::string& tag) const {
    std::set<int> all;
    for (const Element& element : elements)
      if (element.shape.dimension == dimension)
        all.insert(element.groups.begin(), element.groups.end());
    std::set<int> called;
    std::vector<std::string> tags;
    for (const int group : all) {
      const auto name = file_.names.find({dimension, group});
      const std::string number = fmt::format("{}", group);
      if (tag == number || (name != file_.names.end() && tag == name->second))
        called.insert(group);
      tags.push_back(name == file_.names.end() ? number : name->second);
    }
    if (called.empty())
      fail_missing_tag(parameters_.file, what, tag, tags);
    return called;
  }

  static bool is_in(const Element& element, const std::set<int>& groups) {
    return std::any_of(element.groups.begin(), element.groups.end(),
                       [&](int group) { return groups.contains(group); });
  }

  [[nodiscard]] ForeignSide find_side(const std::string& tag) const {
    const std::set<int> groups = groups_called(file_.elements, 2, "physical surface", tag);
    ForeignSide side;
    for (const Element& element : file_.elements)
      if (element.shape.dimension == 2 && is_in(element, groups))
        side.faces.push_back(mesh::face_key(nodes_of(element)));
    return side;
  }

  [[nodiscard]] std::vector<bool> find_infarcted(const std::string& tag) const {
    const std::set<int> groups = groups_called(cells_, 3, "physical volume", tag);
    std::vector<bool> infarcted;
    for (const Element& cell : cells_)
      infarcted.push_back(is_in(cell, groups));
    return infarcted;
  }

  /// The first physical volume that is called as an infarct is and holds elements of the wall.
  [[nodiscard]] std::optional<UnreadInfarct> unread_infarct() const {
    for (const auto& [group, name] : file_.names)
      if (group.first == 3 && is_infarct_name(name) &&
          std::any_of(cells_.begin(), cells_.end(), [number = group.second](const Element& cell) {
            return cell.groups.contains(number);
          }))
        return UnreadInfarct{name};
    return {};
  }

  const mesh::ImportParameters& parameters_;
  GmshFile file_;
  ForeignMesh foreign_;
  std::vector<Element> cells_;                   ///< of the wall
  std::unordered_map<std::int64_t, int> index_;  ///< of nodes, by number
};

}  // namespace

ForeignMesh read_gmsh(const mesh::ImportParameters& parameters) {
  return Reader(parameters).read();
}

}  // namespace lv::mesh_io
