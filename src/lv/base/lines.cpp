#include "lv/base/lines.hpp"

#include "lv/base/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv {
namespace {

/// Reads what stands in the quotation marks that a text begins with; returns the length of both.
std::size_t take_quoted(std::string_view text, std::string& content) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == '"' && !text.substr(i + 1).starts_with('"'))
      return i + 1;
    content += text[i];
    i += text[i] == '"' ? 1 : 0;
  }
  return text.size();
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank(" \t\r\n\0", 5);
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (;;) {
    const auto end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos)
      return fields;
    line.remove_prefix(end + 1);
  }
}

std::vector<std::string> csv_fields(std::string_view line) {
  std::vector<std::string> fields;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    std::string quoted;
    if (line.starts_with('"'))
      line.remove_prefix(take_quoted(line, quoted));
    const auto end = line.find(',');
    fields.push_back(quoted + std::string(trimmed(line.substr(0, end))));
    if (end == std::string_view::npos)
      return fields;
    line.remove_prefix(end + 1);
  }
}

LineReader::LineReader(const std::filesystem::path& file) : file_(file.string()) {
  if (why_unreadable(file).empty())
    stream_.open(file);
}

bool LineReader::next() {
  constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
  while (std::getline(stream_, text_)) {
    ++number_;
    if (number_ == 1 && text_.starts_with(utf8_mark))
      text_.erase(0, utf8_mark.size());
    if (text_.ends_with('\r'))
      text_.pop_back();
    if (!trimmed(text_).empty())
      return true;
  }
  return false;
}

std::string LineReader::where() const {
  return fmt::format("{}:{}", file_, number_);
}

}  // namespace lv
