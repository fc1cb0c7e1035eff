#pragma once

#include <string>

namespace lv::log {

/// Writes a warning to the file of log::to_file alone, if there is one: of what the terminal is
/// told by other means.
void keep(const std::string& line);

}  // namespace lv::log
