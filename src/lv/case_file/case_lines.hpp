#pragma once

#include "lv/case_file/case.hpp"

#include <string>
#include <vector>

namespace lv::case_file {

/// The table and the key of a parameter's name: "blood" and "density" of "blood.density".
[[nodiscard]] std::string table_of(const std::string& parameter);
[[nodiscard]] std::string key_of(const std::string& parameter);

/// One line of a case file.
struct CaseLine {
  std::string parameter;  ///< with its tables
  std::string value;      ///< as it stands in the file
  std::string comment;    ///< behind it; may be empty
  bool active = true;     ///< else it stands there as a comment, to be uncommented
};

/// Stands for a value that only the user knows. A case file with it is refused, naming all of them.
inline constexpr const char* fill_in = "\"FILL IN\"";

/// Text and a list of whole numbers as they stand in a case file. Throws InputError for a text that
/// cannot, as it is not UTF-8.
[[nodiscard]] std::string quoted(const std::string& text);
[[nodiscard]] std::string listed(const std::vector<int>& numbers);

/// The first lines of any new case: name and engine.
[[nodiscard]] std::string first_lines(const std::string& name);

/// The lines under the headings of their tables, in the order in which each table comes first. A
/// table of which no line is active has its heading in a comment too.
[[nodiscard]] std::string case_lines(const std::vector<CaseLine>& lines);

/// The same for a case that exists: lines for a table that it has are said to belong there, since a
/// heading may stand in a file only once.
[[nodiscard]] std::string lines_to_add(const Case& c, const std::vector<CaseLine>& lines);

/// What a case does not say and must. Tells all of it at once, with lines to paste.
class Missing {
 public:
  void add(CaseLine line) { lines_.push_back(std::move(line)); }
  [[nodiscard]] bool empty() const { return lines_.empty(); }

  /// Throws InputError unless nothing is missing: "a.b, a.c and a.d are not set" with `found`, what
  /// there is to choose from, behind it, and the lines to add.
  void raise(const Case& c, const std::string& where, const std::string& found = "") const;

 private:
  std::vector<CaseLine> lines_;
};

}  // namespace lv::case_file
