#include "lv/mesh_io/abaqus_model.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

namespace lv::mesh_io {
namespace {

using Number = AbaqusModel::Number;
using Use = AbaqusElementType::Use;

constexpr std::size_t most_members = 20'000'000;  // of all sets together
constexpr int most_nodes = 27;                    // of an element

AbaqusElementType volume_type(int nodes) {
  struct Shape {
    std::string name;
    int corners;
  };
  static const std::map<int, Shape> shapes{
      {4, {tetrahedron_name, 4}}, {5, {"pyramid", 5}},         {6, {"wedge", 6}},
      {8, {hexahedron_name, 8}},  {10, {tetrahedron_name, 4}}, {15, {"quadratic wedge", 6}},
      {20, {hexahedron_name, 8}}, {27, {hexahedron_name, 8}}};
  const auto found = shapes.find(nodes);
  if (found == shapes.end())
    return {Use::volume, nodes, fmt::format("solid of {} nodes", nodes), nodes};
  return {Use::volume, nodes, found->second.name, found->second.corners};
}

/// The number that follows `prefix` in an element type's name: 8 in C3D8R.
std::optional<int> digits_after(std::string_view type, std::string_view prefix) {
  if (!type.starts_with(prefix))
    return {};
  type.remove_prefix(prefix.size());
  const auto nodes = number_of<int>(type.substr(0, type.find_first_not_of("0123456789")));
  return nodes && *nodes <= most_nodes ? nodes : std::nullopt;
}

bool has_no_volume(const std::string& type) {
  static const std::array<std::string_view, 14> prefixes{
      "T2D",    "T3D",     "B2",   "B3", "PIPE", "MASS", "ROTARYI",
      "SPRING", "DASHPOT", "CONN", "RB", "R2D",  "GAP",  "DCOUP"};
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](std::string_view prefix) { return type.starts_with(prefix); });
}

AbaqusElementType element_type(const std::string& type) {
  for (const std::string_view prefix : {"C3D", "DC3D", "AC3D"})
    if (const auto nodes = digits_after(type, prefix))
      return volume_type(*nodes);
  if (type.starts_with("STRI65"))
    return {Use::surface, 6, "", 3};
  for (const std::string_view prefix :
       {"S", "STRI", "M3D", "SFM3D", "R3D", "CPS", "CPE", "DS", "F3D"})
    if (const auto nodes = digits_after(type, prefix); nodes && *nodes >= 3 && *nodes <= 9)
      return {Use::surface, *nodes, "", *nodes == 3 || *nodes == 6 ? 3 : 4};
  if (has_no_volume(type))
    return {};
  return {Use::volume, 0, "unknown type " + type, 0};
}

class ModelReader {
 public:
  AbaqusModel read(const AbaqusFile& file) {
    model_.files = file.files;
    for (const AbaqusBlock& block : file.blocks)
      read_block(block);
    if (scope_ == Scope::part)
      model_.fail(part_at_, "*Part is not followed by *End Part", "The file seems to be truncated");
    return std::move(model_);
  }

 private:
  enum class Scope { model, part, assembly, instance };

  void read_block(const AbaqusBlock& block) {
    if (follow_scope(block))
      return;
    // nodes and sets of the assembly itself are reference points and their like
    if (scope_ == Scope::assembly && !block.has("INSTANCE") && block.keyword != "SURFACE")
      return;
    if (block.keyword == "NODE")
      read_nodes(block);
    else if (block.keyword == "ELEMENT")
      read_elements(block);
    else if (block.keyword == "NSET")
      read_node_set(block);
    else if (block.keyword == "ELSET")
      read_set(block, model_.element_sets, block.option("ELSET"));
    else if (block.keyword == "SURFACE")
      read_surface(block);
    else if (block.keyword == "ORIENTATION" || block.keyword == "DISTRIBUTION")
      note_orientation(block);
    else
      refuse_generated(block);
  }

  void note_orientation(const AbaqusBlock& block) {
    if (!std::exchange(is_oriented_, true))
      model_.notes.push_back(fmt::format(
          "*{} in line {}, which may hold fibres, is not read: they follow the rule of [fibres], "
          "or come with a .vtu file",
          block.keyword, block.at.number));
  }

  /// True if the block only opens or closes a part, the assembly or an instance.
  bool follow_scope(const AbaqusBlock& block) {
    if (block.keyword == "PART") {
      scope_ = Scope::part;
      part_at_ = block.at;
    } else if (block.keyword == "ASSEMBLY" || block.keyword == "END INSTANCE") {
      scope_ = Scope::assembly;
    } else if (block.keyword == "INSTANCE") {
      scope_ = Scope::instance;
      refuse_second_instance(block);
      if (!block.data.empty())
        model_.notes.push_back(fmt::format(
            "{}: the instance's place in the assembly is left aside; coordinates are the part's",
            format_line(model_.files, block.at)));
    } else if (block.keyword == "END PART" || block.keyword == "END ASSEMBLY") {
      scope_ = Scope::model;
    } else {
      return false;
    }
    return true;
  }

  /// Places in the assembly are left aside: two instances of a part would lie in each other.
  void refuse_second_instance(const AbaqusBlock& block) {
    const std::string part = block.option("PART");
    const auto [first, added] = instance_of_.emplace(part, block.at);
    if (!part.empty() && !added)
      model_.fail(block.at,
                  fmt::format("the part {} has a second instance (the first at {})", part,
                              format_line(model_.files, first->second)),
                  "A mesh is read of one instance: write the heart's part with one alone");
  }

  void refuse_generated(const AbaqusBlock& block) const {
    static const std::set<std::string> generating{"NGEN",  "NFILL",  "NCOPY", "NMAP",
                                                  "ELGEN", "ELCOPY", "SYSTEM"};
    if (generating.contains(block.keyword))
      model_.fail(block.at, fmt::format("*{} is not understood", block.keyword),
                  "Write the mesh with all nodes and elements listed, as pre-processors do");
  }

  void read_nodes(const AbaqusBlock& block) {
    if (block.has("SYSTEM") && block.option("SYSTEM") != "R")
      model_.fail(block.at, "gives nodes in a cylindrical or spherical system",
                  "Write the nodes in Cartesian coordinates");
    for (const AbaqusLine& line : block.data) {
      const AbaqusModel::Node node = parse_node(line);
      const auto [entry, added] =
          model_.node_index.emplace(node.number, static_cast<int>(model_.nodes.size()));
      if (!added)
        fail_repeated(line.at, "node", node.number, model_.nodes[entry->second].at);
      model_.nodes.push_back(node);
      if (block.has("NSET"))
        model_.node_sets[block.option("NSET")].push_back(node.number);
    }
  }

  [[nodiscard]] AbaqusModel::Node parse_node(const AbaqusLine& line) const {
    const auto fields = abaqus_fields(line.text);
    if (fields.size() < 4)
      model_.fail(line.at,
                  fmt::format("\"{}\" is not a node's number and three coordinates", line.text),
                  "The file seems to be truncated or damaged");
    AbaqusModel::Node node{whole_number(fields[0], line.at), Vec3::Zero(), line.at};
    for (int d = 0; d < 3; ++d) {
      const auto x = number_of<double>(fields[1 + d]);
      if (!x)
        model_.fail(line.at, fmt::format("\"{}\" is not a coordinate", fields[1 + d]),
                    "The file seems to be damaged");
      node.X[d] = *x;
    }
    return node;
  }

  [[noreturn]] void fail_repeated(FileLine at, const char* what, Number number,
                                  FileLine first) const {
    model_.fail(at,
                fmt::format("{} {} is defined a second time (first at {})", what, number,
                            format_line(model_.files, first)),
                fmt::format("Give every {} its own number, and import one part at a time", what));
  }

  void read_elements(const AbaqusBlock& block) {
    const AbaqusElementType type = element_type(block.option("TYPE"));
    if (type.use == Use::other)
      return;
    if (type.nodes == 0) {
      model_.volume_shapes[type.shape] += static_cast<int>(block.data.size());
      return;
    }
    // an element's nodes may go on over several lines
    AbaqusModel::Element element{0, type, {}, {}};
    std::vector<Number> numbers;
    for (const AbaqusLine& line : block.data) {
      if (numbers.empty())
        element.at = line.at;
      for (const std::string_view field : abaqus_fields(line.text))
        numbers.push_back(whole_number(field, line.at));
      const int missing = type.nodes + 1 - static_cast<int>(numbers.size());
      if (missing < 0)
        model_.fail(line.at,
                    fmt::format("element {} has more than the {} nodes of its type {}", numbers[0],
                                type.nodes, block.option("TYPE")),
                    "Correct the type or the list of nodes");
      if (missing == 0) {
        element.number = numbers[0];
        element.nodes.assign(numbers.begin() + 1, numbers.begin() + 1 + type.corners);
        add_element(element, block.option("ELSET"));
        numbers.clear();
      }
    }
    if (!numbers.empty())
      model_.fail(element.at,
                  fmt::format("element {} has {} of its {} nodes", numbers[0], numbers.size() - 1,
                              type.nodes),
                  "The file seems to be truncated");
  }

  void add_element(const AbaqusModel::Element& element, const std::string& set) {
    const auto [entry, added] =
        model_.element_index.emplace(element.number, static_cast<int>(model_.elements.size()));
    if (!added)
      fail_repeated(element.at, "element", element.number, model_.elements[entry->second].at);
    model_.elements.push_back(element);
    if (element.type.use == Use::volume) {
      ++model_.volume_shapes[element.type.shape];
      model_.quadratic += element.type.nodes > element.type.corners ? 1 : 0;
    }
    if (!set.empty())
      model_.element_sets[set].push_back(element.number);
  }

  [[nodiscard]] Number whole_number(std::string_view field, FileLine at) const {
    const auto number = number_of<Number>(field);
    if (!number)
      model_.fail(at, fmt::format("\"{}\" is not a whole number", field),
                  "The file seems to be truncated or damaged");
    return *number;
  }

  void read_node_set(const AbaqusBlock& block) {
    read_set(block, model_.node_sets, block.option("NSET"));
    if (!block.has("ELSET"))
      return;
    std::vector<Number>& set = model_.node_sets[block.option("NSET")];
    for (const Number number :
         model_.members(model_.element_sets, block.option("ELSET"), block.at)) {
      const auto found = model_.element_index.find(number);
      if (found != model_.element_index.end())
        extend(set, model_.elements[found->second].nodes, block.at);
    }
  }

  void read_set(const AbaqusBlock& block, AbaqusModel::Sets& sets, const std::string& name) {
    std::vector<Number>& set = sets[name];
    for (const AbaqusLine& line : block.data) {
      const auto fields = abaqus_fields(line.text);
      if (block.has("GENERATE")) {
        extend(set, generated(fields, line), line.at);
        continue;
      }
      for (const std::string_view field : fields)
        extend(set, model_.members(sets, std::string(field), line.at), line.at);
    }
  }

  /// Sets may hold sets and ranges: a few lines can mean more members than any mesh has.
  void extend(std::vector<Number>& set, const std::vector<Number>& more, FileLine at) {
    members_ += more.size();
    if (members_ > most_members)
      model_.fail(at, fmt::format("the sets hold more than {} members", most_members),
                  "Write the sets that are used alone");
    set.insert(set.end(), more.begin(), more.end());
  }

  /// "first, last, step"
  [[nodiscard]] std::vector<Number> generated(const std::vector<std::string_view>& fields,
                                              const AbaqusLine& line) const {
    std::vector<Number> range;
    for (const std::string_view field : fields)
      range.push_back(whole_number(field, line.at));
    if (range.size() == 2)
      range.push_back(1);
    if (range.size() != 3 || range[0] < 1 || range[1] < range[0] || range[2] < 1 ||
        static_cast<std::size_t>((range[1] - range[0]) / range[2]) > most_members)
      model_.fail(line.at, fmt::format("\"{}\" is not \"first, last, step\"", line.text),
                  "Correct the range");
    std::vector<Number> numbers;
    const Number count = (range[1] - range[0]) / range[2] + 1;
    for (Number k = 0; k < count; ++k)
      numbers.push_back(range[0] + k * range[2]);
    return numbers;
  }

  void read_surface(const AbaqusBlock& block) {
    const std::string type = block.option("TYPE");
    if (!type.empty() && type != "ELEMENT" && type != "NODE")
      return;  // analytical surfaces and the like
    AbaqusModel::Surface& surface = model_.surfaces[block.option("NAME")];
    surface.of_nodes = type == "NODE";
    for (const AbaqusLine& line : block.data) {
      const auto fields = abaqus_fields(line.text);
      if (!fields.empty())
        surface.entries.push_back(
            {std::string(fields[0]), fields.size() > 1 ? upper_case(fields[1]) : "", line.at});
    }
  }

  AbaqusModel model_;
  Scope scope_ = Scope::model;
  FileLine part_at_;
  std::map<std::string, FileLine> instance_of_;  ///< where a part has its first
  std::size_t members_ = 0;                      ///< of all sets so far
  bool is_oriented_ = false;
};

}  // namespace

std::vector<Number> AbaqusModel::members(const Sets& sets, const std::string& name,
                                         FileLine at) const {
  const std::string own = upper_case(name.substr(name.rfind('.') + 1));
  if (const auto number = number_of<Number>(own))
    return {*number};
  const auto found = sets.find(own);
  if (found == sets.end())
    fail(at, fmt::format("there is no set \"{}\" before this line", name),
         "Correct the name, or define the set first");
  return found->second;
}

void AbaqusModel::fail(FileLine at, const std::string& what, const std::string& remedy) const {
  throw InputError(format_line(files, at), what, remedy);
}

AbaqusModel read_abaqus_model(const std::string& file) {
  return ModelReader().read(read_abaqus_blocks(file));
}

}  // namespace lv::mesh_io
