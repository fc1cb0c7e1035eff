#pragma once

#include <filesystem>
#include <string>

namespace lv {

/// The ending of a file's name, with its dot and in lower case: ".stl" of "SCAR.STL".
[[nodiscard]] std::string ending_of(const std::filesystem::path& file);

}  // namespace lv
