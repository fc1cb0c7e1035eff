#pragma once

#include <filesystem>
#include <string>

namespace lv::job {

/// What a file that can be read seems to be, by its first bytes and else by its ending, and where a
/// case names such a file: "an STL surface (infarct.surface.file)".
[[nodiscard]] std::string what_is(const std::filesystem::path& file);

}  // namespace lv::job
