#pragma once

#include "lv/case_file/case.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace lv::case_file {

/// Reads a case file. Every key must be a known parameter with a value that its declaration allows.
/// Throws InputError that names each mistake with file:line, the rule and the nearest valid name,
/// or each of several files that the case names and that are not there.
[[nodiscard]] Case read_case(const std::filesystem::path& file);

/// The same from text, as if it were in `file`.
[[nodiscard]] Case parse_case(const std::string& text, const std::filesystem::path& file);

/// A number of a case that is multiplied, and the place in the case file that asks for it.
struct Change {
  std::string parameter;
  double factor = 1.0;
  std::string place;
};

/// The case with these changes, checked as if its file had them. Throws InputError that names each
/// mistake with the place of its change.
[[nodiscard]] Case changed(const Case& c, const std::vector<Change>& changes);

/// A commented case file with the parameters a new user is likely to change.
[[nodiscard]] std::string starter_case(const std::string& name);

/// The manual of all parameters as text for a terminal, or as Markdown; with a filter, of those
/// whose name or meaning contains it. Throws InputError, with the name most like it, if none does.
[[nodiscard]] std::string manual(bool markdown, const std::string& filter = "");

}  // namespace lv::case_file
