#include "lv/base/lines.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <type_traits>

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

template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const char* all = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), all, value);
  return error == std::errc() && end == all ? std::optional(value) : std::nullopt;
}

/// A number with an exponent of Fortran's, written as everywhere: "1.5D+01" is 1.5e+01, and of the
/// form "1.5+101" is 1.5e+101. Other texts are none.
std::string without_fortran(std::string_view text) {
  std::string number(text);
  const auto letter = number.find_first_of("dD");
  const auto sign = number.find_last_of("+-");
  constexpr std::size_t digits = 3;
  if (letter != std::string::npos)
    number[letter] = 'e';
  else if (sign != std::string::npos && sign + digits + 1 == number.size() &&
           number.find('.') < sign)
    number = fmt::format("{}e{}", text.substr(0, sign), text.substr(sign));
  return number;
}

/// `where` is the file, or a line of it.
[[noreturn]] void fail_encoding(const std::filesystem::path& file, const std::string& where,
                                const std::string& what) {
  throw InputError(where, what,
                   ending_of(file) == ".csv"
                       ? "Save it as UTF-8 (a spreadsheet calls this \"CSV UTF-8\")"
                       : "Save it as UTF-8");
}

void check_mark(const std::string& file, std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    fail_encoding(file, file, "is not UTF-8 text but UTF-16 or UTF-32");
}

/// The lines of Windows (CR LF) and of old Macs (CR) end as those of Unix.
std::string with_newlines(std::string_view text) {
  std::string lines;
  lines.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r')
      lines += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      lines += '\n';
  }
  return lines;
}

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// "12", "-12" and "+12".
bool whole(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+'))
    text.remove_prefix(1);
  return all_digits(text);
}

/// How many numbers may have fallen into two fields each at their decimal commas.
std::size_t split_numbers(const std::vector<std::string>& fields) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < fields.size(); ++i)
    if (whole(fields[i]) && all_digits(fields[i + 1])) {
      ++count;
      ++i;
    }
  return count;
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

bool has_decimal_comma(std::string_view text) {
  const auto comma = text.find(',');
  if (comma == std::string_view::npos || !whole(text.substr(0, comma)))
    return false;
  const std::string_view after = text.substr(comma + 1);
  const auto exponent = after.find_first_of("eE");
  return all_digits(after.substr(0, exponent)) &&
         (exponent == std::string_view::npos || whole(after.substr(exponent + 1)));
}

std::string why_no_number(std::string_view text, std::string_view what) {
  return fmt::format("\"{}\" {}", text,
                     has_decimal_comma(text) ? "has a decimal comma; write a decimal point" : what);
}

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  if (text.starts_with('+'))
    text.remove_prefix(1);
  const auto number = parsed<Number>(text);
  if constexpr (std::is_floating_point_v<Number>)
    return number ? number : parsed<Number>(without_fortran(text));
  return number;
}
template std::optional<int> number_of(std::string_view text);
template std::optional<std::int64_t> number_of(std::string_view text);
template std::optional<double> number_of(std::string_view text);

void check_encoding(const std::string& file) {
  std::array<char, 2> first{};
  std::ifstream(file, std::ios::binary).read(first.data(), first.size());
  check_mark(file, {first.data(), first.size()});
}

std::string read_text(const std::filesystem::path& file) {
  std::string text = read_file(file);
  check_mark(file.string(), text);
  if (text.starts_with("\xEF\xBB\xBF"))
    text.erase(0, 3);
  text = with_newlines(text);
  if (const auto nul = text.find('\0'); nul != std::string::npos) {
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
    fail_encoding(file, fmt::format("{}:{}", file.string(), line),
                  "is not UTF-8 text: it holds characters NUL, as UTF-16 and damaged files do");
  }
  return text;
}

void CsvCheck::check(std::string_view line, const std::string& where) {
  if (trimmed(line).starts_with('#'))
    return;
  const bool is_first = columns_ == 0;
  const std::vector<std::string> fields = csv_fields(line);
  columns_ = is_first ? fields.size() : columns_;
  const auto other = line.find_first_of(";\t");
  if (fields.size() == 1 && other != std::string_view::npos && (is_first || columns_ > 1))
    throw InputError(
        where, fmt::format("columns are separated by {}", line[other] == ';' ? "';'" : "tabs"),
        "Save it with commas between columns and with decimal points");
  for (const std::string& field : fields)
    if (has_decimal_comma(field))
      throw InputError(where, why_no_number(field, "is no number"),
                       "In a spreadsheet, choose English numbers before you save the table");
  if (fields.size() > columns_ && columns_ + split_numbers(fields) >= fields.size())
    throw InputError(where,
                     fmt::format("{} values in a table of {} columns, perhaps because numbers "
                                 "have decimal commas",
                                 fields.size(), columns_),
                     "Give every line one value per column, and numbers a decimal point");
}

LineReader::LineReader(const std::filesystem::path& file, Columns columns) : file_(file.string()) {
  if (columns == Columns::by_ending && ending_of(file) == ".csv")
    csv_.emplace();
  is_open_ = unreadable(file).empty();
  if (is_open_)
    text_ = read_text(file);
}

bool LineReader::next() {
  while (next_ < text_.size()) {
    ++number_;
    begin_ = next_;
    end_ = std::min(text_.find('\n', begin_), text_.size());
    next_ = end_ + 1;
    if (trimmed(text()).empty())
      continue;
    if (csv_)
      csv_->check(text(), where());
    return true;
  }
  return false;
}

std::string LineReader::where() const {
  return fmt::format("{}:{}", file_, number_);
}

}  // namespace lv
