#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace lv::image {

/// So many bytes of a file, by which its format is known; fewer if it is shorter, none if it cannot
/// be read.
[[nodiscard]] std::string first_bytes(const std::filesystem::path& file, std::size_t count);

}  // namespace lv::image
