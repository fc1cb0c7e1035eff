#pragma once

#include <filesystem>
#include <string>

namespace lv::proposal {

/// What a file that kind_of does not know by its name or contents seems to be, by its first bytes,
/// and where a case names such a file: "a PLY surface (infarct.surface.file)".
[[nodiscard]] std::string what_is(const std::filesystem::path& file);

/// Whether a file begins as text does: without control characters.
[[nodiscard]] bool begins_as_text(const std::filesystem::path& file);

}  // namespace lv::proposal
