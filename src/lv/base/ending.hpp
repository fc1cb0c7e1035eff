#pragma once

#include <filesystem>
#include <string>

namespace lv {

/// A text with the letters of ASCII in lower case.
[[nodiscard]] std::string lower_case(std::string text);

/// The ending of a file's name, with its dot and in lower case: ".stl" of "SCAR.STL".
[[nodiscard]] std::string ending_of(const std::filesystem::path& file);

}  // namespace lv
