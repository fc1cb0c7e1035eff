#include "lv/mesh_io/gmsh_file.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>

namespace lv::mesh_io {
namespace {

constexpr std::string_view gaps = " \t\r\n";

const std::map<int, GmshShape>& shapes() {
  static const std::map<int, GmshShape> known{
      {1, {1, 2, 2, "Line 2"}},           {2, {2, 3, 3, "Triangle 3"}},
      {3, {2, 4, 4, "Quadrilateral 4"}},  {4, {3, 4, 4, "Tetrahedron 4"}},
      {5, {3, 8, 8, "Hexahedron 8"}},     {6, {3, 6, 6, "Prism 6"}},
      {7, {3, 5, 5, "Pyramid 5"}},        {8, {1, 3, 2, "Line 3"}},
      {9, {2, 6, 3, "Triangle 6"}},       {10, {2, 9, 4, "Quadrilateral 9"}},
      {11, {3, 10, 4, "Tetrahedron 10"}}, {12, {3, 27, 8, "Hexahedron 27"}},
      {13, {3, 18, 6, "Prism 18"}},       {14, {3, 14, 5, "Pyramid 14"}},
      {15, {0, 1, 1, "Point"}},           {16, {2, 8, 4, "Quadrilateral 8"}},
      {17, {3, 20, 8, "Hexahedron 20"}},  {18, {3, 15, 6, "Prism 15"}},
      {19, {3, 13, 5, "Pyramid 13"}},     {21, {2, 10, 3, "Triangle 10"}},
      {26, {1, 4, 2, "Line 4"}},          {29, {3, 20, 4, "Tetrahedron 20"}}};
  return known;
}

/// Numbers and lines from the front of a file.
class Cursor {
 public:
  Cursor(const std::string& file, std::string_view text) : file_(file), text_(text) {}

  void set_binary(bool swapped) { binary_ = true, swapped_ = swapped; }
  [[nodiscard]] bool is_binary() const { return binary_; }

  void skip_blanks() { at_ = std::min(text_.find_first_not_of(gaps, at_), text_.size()); }
  [[nodiscard]] bool is_at_end() const { return at_ == text_.size(); }

  std::string_view line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view found = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    return trimmed(found);
  }

  std::string_view word() {
    skip_blanks();
    const std::string_view rest = text_.substr(at_);
    const std::string_view found = rest.substr(0, rest.find_first_of(gaps));
    at_ += found.size();
    return found;
  }

  /// A number that is text in all files.
  template <class Number>
  Number written() {
    const std::string_view text = word();
    const auto number = number_of<Number>(text);
    if (!number)
      fail(fmt::format("\"{}\" is not a number", text));
    return *number;
  }

  /// A number of the kind that the file has: text, or bytes.
  template <class Number>
  Number number() {
    if (!binary_)
      return written<Number>();
    std::array<char, sizeof(Number)> bytes{};
    if (text_.size() - at_ < bytes.size())
      fail("it ends too early");
    std::copy_n(text_.begin() + static_cast<std::ptrdiff_t>(at_), bytes.size(), bytes.begin());
    if (swapped_)
      std::reverse(bytes.begin(), bytes.end());
    at_ += bytes.size();
    Number value;
    std::memcpy(&value, bytes.data(), sizeof(Number));
    return value;
  }

  void skip_to(const std::string& mark) {
    const std::size_t found = text_.find(mark, at_);
    if (found == std::string_view::npos)
      fail(fmt::format("{} is missing", mark));
    at_ = found;
  }

  /// The place's line in a text file, 0 in a binary one.
  [[nodiscard]] int line_number() {
    if (binary_)
      return 0;
    const auto begin = text_.begin() + static_cast<std::ptrdiff_t>(counted_to_);
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(at_);
    line_number_ += static_cast<int>(std::count(begin, end, '\n'));
    counted_to_ = at_;
    return line_number_;
  }

  [[noreturn]] void fail(const std::string& what) {
    throw InputError(binary_ ? file_ : fmt::format("{}:{}", file_, line_number()),
                     fmt::format("cannot be read: {}", what),
                     "The file seems to be truncated or damaged");
  }

 private:
  const std::string& file_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t counted_to_ = 0;
  int line_number_ = 1;
  bool binary_ = false;
  bool swapped_ = false;
};

/// Section by section.
class GmshReader {
 public:
  explicit GmshReader(const std::string& file) : text_(read_file(file)), cursor_(file, text_) {}

  GmshFile read() {
    for (cursor_.skip_blanks(); !cursor_.is_at_end(); cursor_.skip_blanks())
      read_section(std::string(cursor_.line()));
    if (by_entity_) {
      sort_by_number(result_.nodes);
      sort_by_number(result_.elements);
    }
    return std::move(result_);
  }

 private:
  template <class Numbered>
  static void sort_by_number(std::vector<Numbered>& all) {
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.number < b.number; });
  }

  void read_section(const std::string& heading) {
    if (!heading.starts_with('$'))
      cursor_.fail(fmt::format("\"{}\" is no section", heading));
    const std::string end = "$End" + heading.substr(1);
    if (heading == "$MeshFormat")
      read_format();
    else if (heading == "$PhysicalNames")
      read_names();
    else if (heading == "$Entities")
      read_entities();
    else if (heading == "$PartitionedEntities")
      read_partitions();
    else if (heading == "$Nodes")
      by_entity_ ? read_blocks([this] { read_nodes_of_entity(); }) : read_nodes();
    else if (heading == "$Elements")
      by_entity_ ? read_blocks([this] { read_elements_of_entity(); }) : read_elements();
    else
      cursor_.skip_to(end);
    result_.has_fields = result_.has_fields || heading.ends_with("Data");
    if (cursor_.word() != end)
      cursor_.fail(fmt::format("{} does not end where its count says", heading));
  }

  void read_format() {
    by_entity_ = cursor_.written<double>() == 4.1;
    const int kind = cursor_.written<int>();
    const int bytes_of_size = cursor_.written<int>();
    static_cast<void>(cursor_.line());
    if (kind != 1)
      return;
    if (by_entity_ && bytes_of_size != 8)
      cursor_.fail(fmt::format("its counts have {} bytes, not 8", bytes_of_size));
    cursor_.set_binary(false);
    cursor_.set_binary(cursor_.number<std::int32_t>() != 1);
  }

  void read_names() {
    const int count = cursor_.written<int>();
    for (int i = 0; i < count; ++i) {
      const int dimension = cursor_.written<int>();
      const int number = cursor_.written<int>();
      std::string_view name = trimmed(cursor_.line());
      if (name.size() >= 2 && name.front() == '"' && name.back() == '"')
        name = name.substr(1, name.size() - 2);
      result_.names[{dimension, number}] = name;
    }
  }

  // Format 4.1.

  /// Points, curves, surfaces and volumes.
  void read_entities(bool of_partitions = false) {
    std::array<std::int64_t, 4> counts{};
    for (std::int64_t& count : counts)
      count = size();
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::int64_t i = 0; i < counts[dimension]; ++i)
        read_entity(dimension, of_partitions);
  }

  void read_partitions() {
    static_cast<void>(size());
    skip_wholes(2 * size());  // ghosts: tag and partition
    read_entities(true);
  }

  /// An entity's groups; those of partitions name their parent and their partitions too.
  void read_entity(int dimension, bool of_partition) {
    const std::int64_t tag = whole();
    if (of_partition) {
      skip_wholes(2);
      skip_wholes(size());
    }
    const int box = dimension == 0 ? 3 : 6;
    for (int i = 0; i < box; ++i)
      static_cast<void>(cursor_.number<double>());
    std::set<int>& groups = groups_[{dimension, tag}];
    const std::int64_t count = size();
    for (std::int64_t i = 0; i < count; ++i)
      add_group(whole(), groups);
    if (dimension > 0)
      skip_wholes(size());  // what bounds it
  }

  void skip_wholes(std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i)
      static_cast<void>(whole());
  }

  /// The nodes or elements of one entity after the other.
  template <class ReadBlock>
  void read_blocks(const ReadBlock& read_block) {
    const std::int64_t blocks = size();
    for (int i = 0; i < 3; ++i)
      static_cast<void>(size());  // how many, and their least and largest number
    for (std::int64_t i = 0; i < blocks; ++i)
      read_block();
  }

  /// All numbers, then all places, with coordinates on the entity if it is parametric.
  void read_nodes_of_entity() {
    const std::int64_t dimension = whole();
    static_cast<void>(whole());
    const std::int64_t parameters = whole() == 0 ? 0 : dimension;
    const std::int64_t count = size();
    const std::size_t first = result_.nodes.size();
    for (std::int64_t i = 0; i < count; ++i) {
      result_.nodes.emplace_back();
      result_.nodes.back().number = size();
    }
    for (std::size_t i = first; i < result_.nodes.size(); ++i) {
      read_place(result_.nodes[i]);
      for (std::int64_t d = 0; d < parameters; ++d)
        static_cast<void>(cursor_.number<double>());
    }
  }

  void read_elements_of_entity() {
    const std::int64_t dimension = whole();
    const std::int64_t entity = whole();
    GmshFile::Element element;
    element.shape = shape(whole());
    element.groups = groups_[{dimension, entity}];
    const std::int64_t count = size();
    for (std::int64_t i = 0; i < count; ++i) {
      element.number = size();
      element.line = cursor_.line_number();
      read_corners(element, [this] { return size(); });
    }
  }

  // Format 2.2.

  void read_nodes() {
    const auto count = cursor_.written<std::int64_t>();
    static_cast<void>(cursor_.line());
    for (std::int64_t i = 0; i < count; ++i) {
      GmshFile::Node node;
      node.number = whole();
      read_place(node);
      result_.nodes.push_back(node);
    }
  }

  void read_elements() {
    const auto count = cursor_.written<std::int64_t>();
    static_cast<void>(cursor_.line());
    if (!cursor_.is_binary())
      for (std::int64_t i = 0; i < count; ++i)
        read_line();
    else
      for (std::int64_t i = 0; i < count;)
        i += read_block();
  }

  /// "number type tags ... nodes"
  void read_line() {
    GmshFile::Element element;
    element.number = whole();
    element.line = cursor_.line_number();
    element.shape = shape(whole());
    read_tags_and_nodes(element, whole());
  }

  /// Elements of one type; how many.
  std::int64_t read_block() {
    GmshFile::Element element;
    element.shape = shape(whole());
    const std::int64_t count = whole();
    const std::int64_t tags = whole();
    if (count < 1)
      cursor_.fail("a block of elements is empty");
    for (std::int64_t i = 0; i < count; ++i) {
      element.number = whole();
      read_tags_and_nodes(element, tags);
    }
    return count;
  }

  /// The first tag is the physical group.
  void read_tags_and_nodes(GmshFile::Element element, std::int64_t tags) {
    for (std::int64_t i = 0; i < tags; ++i)
      if (const std::int64_t tag = whole(); i == 0 && tag != 0)
        add_group(tag, element.groups);
    read_corners(element, [this] { return whole(); });
  }

  // Both formats.

  void read_place(GmshFile::Node& node) {
    for (double& x : node.X)
      x = cursor_.number<double>();
    node.line = cursor_.line_number();
  }

  /// Adds the element with its corners, the first of its nodes.
  template <class Next>
  void read_corners(GmshFile::Element& element, const Next& next) {
    element.corners.clear();
    for (int i = 0; i < element.shape.nodes; ++i)
      if (const std::int64_t node = next(); i < element.shape.corners)
        element.corners.push_back(node);
    result_.elements.push_back(element);
  }

  /// A negative group has its elements the other way round.
  static void add_group(std::int64_t tag, std::set<int>& groups) {
    groups.insert(static_cast<int>(std::abs(tag)));
  }

  std::int64_t whole() {
    return cursor_.is_binary() ? cursor_.number<std::int32_t>() : cursor_.written<std::int64_t>();
  }

  /// Counts and the numbers of nodes and elements in format 4.1.
  std::int64_t size() { return cursor_.number<std::int64_t>(); }

  GmshShape shape(std::int64_t type) {
    const auto found = shapes().find(static_cast<int>(type));
    if (found == shapes().end())
      cursor_.fail(fmt::format("elements of type {} are not known", type));
    return found->second;
  }

  std::string text_;
  Cursor cursor_;
  bool by_entity_ = false;                                                 ///< format 4.1
  std::map<std::pair<std::int64_t, std::int64_t>, std::set<int>> groups_;  ///< of entities
  GmshFile result_;
};

/// Throws InputError unless the file says that it is of a format that is read.
void require_format(const std::string& file) {
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
}

}  // namespace

GmshFile read_gmsh_file(const std::string& file) {
  require_format(file);
  return GmshReader(file).read();
}

}  // namespace lv::mesh_io
