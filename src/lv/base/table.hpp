#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lv {

/// Named columns of numbers and words, row by row; written as CSV, with quotation marks around
/// fields that need them (RFC 4180). A missing number is an empty field, never zero.
class Table {
 public:
  explicit Table(std::vector<std::string> columns);

  void add_row(std::vector<std::string> fields);

  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<std::vector<std::string>>& rows() const { return rows_; }

  /// The numbers of a column; NaN where the field is empty, all of them if there is no such column.
  /// Throws InputError when a field is no number.
  [[nodiscard]] std::vector<double> numbers(const std::string& column) const;

  /// The whole numbers of a column; 0 where the field is empty, all of them if there is no such
  /// column. Throws InputError when a field is no whole number.
  [[nodiscard]] std::vector<int> whole_numbers(const std::string& column) const;

  /// The words of a column; empty ones if there is no such column.
  [[nodiscard]] std::vector<std::string> words(const std::string& column) const;

  /// A file as write_csv makes it; lines with too few fields (half written) are left out. Throws
  /// InputError when the file cannot be read.
  [[nodiscard]] static Table read_csv(const std::filesystem::path& file);

  /// Throws RunError when the file cannot be written.
  void write_csv(const std::filesystem::path& file) const;

  /// A number as CSV text with `digits` significant digits; empty for NaN.
  [[nodiscard]] static std::string number(double value, int digits = 7);

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// Writes a whole text file under a temporary name and renames it: a half-written file never looks
/// whole. Throws RunError naming the file when it cannot be written.
void write_file(const std::filesystem::path& file, const std::string& text);

/// The whole text of a file. Throws InputError when it cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

}  // namespace lv
