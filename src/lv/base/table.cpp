#include "lv/base/table.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

namespace lv {
namespace {

/// A field as RFC 4180 has it: in quotation marks if it would not come back without.
std::string csv_field(const std::string& field) {
  if (field == trimmed(field) && field.find_first_of(",\"\n") == std::string::npos)
    return field;
  std::string quoted = "\"";
  for (const char c : field)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string line_of(const std::vector<std::string>& fields) {
  std::vector<std::string> written;
  std::transform(fields.begin(), fields.end(), std::back_inserter(written), csv_field);
  return fmt::format("{}\n", fmt::join(written, ","));
}

/// The text of the next row: a line, and those after it as long as a quotation mark is open.
bool next_row(std::istream& lines, std::string& row) {
  if (!std::getline(lines, row))
    return false;
  std::string more;
  while (std::count(row.begin(), row.end(), '"') % 2 != 0 && std::getline(lines, more))
    row += '\n' + more;
  return true;
}

/// The numbers that fields hold; `missing` for empty ones.
template <class Number>
std::vector<Number> parsed(const std::vector<std::string>& fields, const std::string& column,
                           Number missing) {
  std::vector<Number> numbers;
  for (const std::string& field : fields) {
    const auto value = field.empty() ? std::optional(missing) : number_of<Number>(field);
    if (!value)
      throw InputError(fmt::format("column {}", column),
                       why_no_number(field, "is not such a number as this column holds"),
                       "The table seems to be damaged");
    numbers.push_back(*value);
  }
  return numbers;
}

}  // namespace

Table::Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

void Table::add_row(std::vector<std::string> fields) {
  LV_CHECK(fields.size() == columns_.size());
  rows_.push_back(std::move(fields));
}

std::vector<std::string> Table::words(const std::string& column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  std::vector<std::string> result(rows_.size());
  if (found != columns_.end())
    for (std::size_t i = 0; i < rows_.size(); ++i)
      result[i] = rows_[i][found - columns_.begin()];
  return result;
}

std::vector<double> Table::numbers(const std::string& column) const {
  return parsed(words(column), column, std::numeric_limits<double>::quiet_NaN());
}

std::vector<int> Table::whole_numbers(const std::string& column) const {
  return parsed(words(column), column, 0);
}

Table Table::read_csv(const std::filesystem::path& file) {
  std::istringstream lines(read_file(file));
  std::string row;
  next_row(lines, row);
  Table table(csv_fields(row));
  while (next_row(lines, row))
    if (auto fields = csv_fields(row); fields.size() == table.columns_.size())
      table.add_row(std::move(fields));
  return table;
}

void Table::write_csv(const std::filesystem::path& file) const {
  std::string text = line_of(columns_);
  for (const auto& row : rows_)
    text += line_of(row);
  write_file(file, text);
}

std::string Table::number(double value, int digits) {
  return std::isnan(value) ? "" : fmt::format("{:.{}g}", value, digits);
}

namespace {

/// What to do about a file that cannot be written.
std::string way_to_write(const std::filesystem::path& file) {
  std::error_code none;
  const std::filesystem::path folder = file.parent_path();
  if (!folder.empty() && !std::filesystem::exists(folder, none))
    return fmt::format("There is no folder {}: make it, or name another one", folder.string());
  if (std::filesystem::is_directory(file, none))
    return "It is a folder: name a file, in it or elsewhere";
  return "Check the folder's permissions and the space left on the disk";
}

}  // namespace

void write_file(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path unfinished = file.string() + ".part";
  std::error_code error;
  std::filesystem::remove(unfinished, error);  // whatever it is, a pipe perhaps
  std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (out)
    std::filesystem::rename(unfinished, file, error);
  if (!out || error) {
    const std::string why = error ? error.message() : std::strerror(errno);
    std::filesystem::remove(unfinished, error);
    throw RunError(fmt::format("{} cannot be written: {}", file.string(), why), way_to_write(file));
  }
}

std::string read_file(const std::filesystem::path& file) {
  constexpr std::size_t piece = std::size_t{1} << 20U;
  require_readable(file, "Check the path and its permissions");
  std::error_code error;
  if (const auto size = std::filesystem::file_size(file, error); !error)
    require_memory(file.string(), static_cast<double>(size));
  std::ifstream in(file, std::ios::binary);
  std::string text;
  while (in) {
    const std::size_t before = text.size();
    text.resize(before + piece);
    in.read(text.data() + before, piece);
    text.resize(before + static_cast<std::size_t>(in.gcount()));
  }
  if (!in.eof())
    throw InputError(file.string(), "cannot be read to its end", "Check the disk");
  return text;
}

}  // namespace lv
