#pragma once

#include "lv/base/names_alone.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string>

/// One line per event, from the root rank, to the terminal and to a log file.
namespace lv::log {

/// Sends lines to this file too, from now on, adding to what is there, without the folders of
/// `names`: a log is kept and shared. Only the root writes. Throws RunError there when it cannot.
void to_file(const std::filesystem::path& file, const NamesAlone& names);

/// Keeps quiet on the terminal (for output that a program reads).
void silence();

void info(const std::string& line);
void warn(const std::string& line);

/// Writes a warning to the file of to_file alone, if there is one: of what the terminal is told by
/// other means.
void keep(const std::string& line);

template <class... Args>
void info(fmt::format_string<Args...> format, Args&&... args) {
  info(fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
  warn(fmt::format(format, std::forward<Args>(args)...));
}

/// "3 min 20 s", "1 h 5 min".
[[nodiscard]] std::string duration(double seconds);

}  // namespace lv::log
