#include "lv/mesh_io/abaqus_blocks.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace lv::mesh_io {
namespace {

constexpr int deepest_include = 10;

std::string_view unquote(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// "END  PART" -> "END PART"
std::string single_blanks(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' || (!result.empty() && result.back() != ' '))
      result += c;
  return result;
}

/// "*Element, type=C3D8, elset=WALL"
AbaqusBlock parse_keyword(const std::string& text, FileLine at) {
  AbaqusBlock block;
  block.at = at;
  const auto fields = abaqus_fields(std::string_view(text).substr(1));
  if (!fields.empty())
    block.keyword = single_blanks(upper_case(fields.front()));
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const auto equals = fields[i].find('=');
    const std::string name = upper_case(trimmed(fields[i].substr(0, equals)));
    const bool valued = equals != std::string_view::npos;
    // a path keeps its letters
    const std::string_view value = valued ? unquote(trimmed(fields[i].substr(equals + 1))) : "";
    block.options[name] = name == "INPUT" ? std::string(value) : upper_case(value);
  }
  return block;
}

class BlockReader {
 public:
  AbaqusFile read(const std::string& path) {
    read_file(path, 0);
    return std::move(result_);
  }

 private:
  void read_file(const std::string& path, int depth) {
    LineReader lines(path, Columns::any);
    if (!lines.is_open())
      throw InputError(path, "cannot be opened", "Check the name and the permission to read");
    const int file = static_cast<int>(result_.files.size());
    result_.files.push_back(path);
    while (lines.next()) {
      const std::string_view text = trimmed(lines.text());
      const FileLine at{file, lines.number()};
      if (text.starts_with("**"))
        continue;
      if (text.front() == '*')
        read_keyword(lines, at, depth);
      else
        add_data(at, text);
    }
  }

  void read_keyword(LineReader& lines, FileLine at, int depth) {
    std::string text(trimmed(lines.text()));
    while (text.back() == ',' && lines.next())
      text += trimmed(lines.text());
    AbaqusBlock block = parse_keyword(text, at);
    if (block.keyword == "INCLUDE")
      include(block, depth);
    else
      result_.blocks.push_back(std::move(block));
  }

  void include(const AbaqusBlock& block, int depth) {
    if (depth >= deepest_include)
      throw InputError(format_line(result_.files, block.at), "includes itself",
                       "Remove the circle of *Include lines");
    const std::filesystem::path folder =
        std::filesystem::path(result_.files[block.at.file]).parent_path();
    read_file((folder / block.option("INPUT")).string(), depth + 1);
  }

  void add_data(FileLine at, std::string_view text) {
    if (result_.blocks.empty())
      throw InputError(format_line(result_.files, at), "has data before the first keyword",
                       "Is this an ABAQUS input file?");
    result_.blocks.back().data.push_back({at, std::string(text)});
  }

  AbaqusFile result_;
};

}  // namespace

std::string AbaqusBlock::option(const std::string& name) const {
  const auto found = options.find(name);
  return found == options.end() ? std::string() : found->second;
}

AbaqusFile read_abaqus_blocks(const std::string& file) {
  return BlockReader().read(file);
}

std::vector<std::string_view> abaqus_fields(std::string_view line) {
  std::vector<std::string_view> fields = fields_of(line, ',');
  if (fields.back().empty())
    fields.pop_back();
  return fields;
}

std::string upper_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

}  // namespace lv::mesh_io
