#pragma once

#include <filesystem>
#include <fstream>
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

/// The lines of a file that are not blank. Ends of lines may be those of Unix or Windows, and a
/// mark of UTF-8 may stand at the beginning.
class LineReader {
 public:
  explicit LineReader(const std::filesystem::path& file);

  /// Whether the file could be opened.
  [[nodiscard]] bool is_open() const { return stream_.is_open(); }
  /// Goes on to the next line; false at the end.
  bool next();
  /// The line without its end.
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] int number() const { return number_; }  ///< of the line, from 1
  [[nodiscard]] std::string where() const;              ///< "file:line"

 private:
  std::string file_;
  std::ifstream stream_;
  std::string text_;
  int number_ = 0;
};

}  // namespace lv
