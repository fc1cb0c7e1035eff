#include "lv/base/table.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <system_error>
#include <utility>

namespace lv {
namespace {

std::string line_of(const std::vector<std::string>& fields) {
  return fmt::format("{}\n", fmt::join(fields, ","));
}

std::vector<std::string> row_of(const std::string& line) {
  const auto fields = fields_of(line, ',');
  return {fields.begin(), fields.end()};
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
  std::vector<double> result;
  for (const std::string& word : words(column))
    result.push_back(word.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(word));
  return result;
}

Table Table::read_csv(const std::filesystem::path& file) {
  std::istringstream lines(read_file(file));
  std::string line;
  std::getline(lines, line);
  Table table(row_of(line));
  while (std::getline(lines, line))
    if (auto fields = row_of(line); fields.size() == table.columns_.size())
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

void write_file(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path unfinished = file.string() + ".part";
  std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  std::error_code error;
  if (out)
    std::filesystem::rename(unfinished, file, error);
  if (!out || error)
    throw RunError(fmt::format("{} cannot be written: {}", file.string(),
                               error ? error.message() : std::strerror(errno)),
                   "Check the folder's permissions and the space left on the disk");
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw InputError(file.string(), "cannot be read", "Check the path and its permissions");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace lv
