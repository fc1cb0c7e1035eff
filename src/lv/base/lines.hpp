#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Text files of people and of other programs, line by line.
namespace lv {

/// The text without spaces, tabs, ends of lines and NUL at either end.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// What stands between the separators, trimmed; one empty field for an empty line.
[[nodiscard]] std::vector<std::string_view> fields_of(std::string_view line, char separator);

/// The same of a line of CSV (RFC 4180): a field in quotation marks may hold commas, and two
/// quotation marks in it stand for one.
[[nodiscard]] std::vector<std::string> csv_fields(std::string_view line);

/// The number (int, std::int64_t or double) that a whole text is. Real numbers may have Fortran's
/// exponents: 1.5D+01, 1.5d1, and 1.5+101, where three digits leave no room for the letter.
template <class Number>
[[nodiscard]] std::optional<Number> number_of(std::string_view text);

/// Whether a text is a number of which a comma stands where the point should: "-11,36".
[[nodiscard]] bool has_decimal_comma(std::string_view text);

/// What is wrong with a text that is no number: `"x" is no number`, where `what` says "is no
/// number", or that it has a decimal comma.
[[nodiscard]] std::string why_no_number(std::string_view text, std::string_view what);

/// The text of a file, every line of which ends with \n: ends of lines may be those of Unix,
/// Windows or old Macs, and a mark of UTF-8 may stand at the beginning. Throws InputError when the
/// file cannot be read, and when it is no text in an encoding that has all of ASCII (UTF-16, NUL).
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// Throws InputError for a file that begins as one in UTF-16 or UTF-32 does.
void check_encoding(const std::string& file);

/// What a spreadsheet of another language writes into a table for commas and decimal points.
class CsvCheck {
 public:
  /// Throws InputError where a line has semicolons or tabs between columns, decimal commas in
  /// quotation marks, or more values than the first line, which decimal commas explain. Lines that
  /// begin with # are comments.
  void check(std::string_view line, const std::string& where);

 private:
  std::size_t columns_ = 0;  ///< of the first line
};

/// What separates the columns of a table.
enum class Columns {
  by_ending,  ///< commas in a file that is named .csv, whose lines pass CsvCheck
  any,
};

/// The lines of a text file (read_text) that are not blank.
class LineReader {
 public:
  /// Throws InputError when the file is no text.
  explicit LineReader(const std::filesystem::path& file, Columns columns = Columns::by_ending);

  /// Whether the file could be opened.
  [[nodiscard]] bool is_open() const { return is_open_; }
  /// Goes on to the next line; false at the end. Throws InputError for a line of .csv that fails
  /// CsvCheck.
  bool next();
  /// The line without its end.
  [[nodiscard]] std::string_view text() const {
    return std::string_view(text_).substr(begin_, end_ - begin_);
  }
  [[nodiscard]] int number() const { return number_; }  ///< of the line, from 1
  [[nodiscard]] std::string where() const;              ///< "file:line"

 private:
  std::string file_;
  bool is_open_ = false;
  std::optional<CsvCheck> csv_;                 ///< of a table with commas
  std::string text_;                            ///< of the file
  std::size_t begin_ = 0, end_ = 0, next_ = 0;  ///< of the line; where the next one begins
  int number_ = 0;
};

}  // namespace lv
