#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lv::page {

/// Whole numbers as text for a page: differences between neighbours (modulo 2^16 or 2^32), their
/// bytes sorted by significance, zlib, base64. Neighbouring nodes have similar values, so the
/// differences are small and their upper bytes compress to almost nothing.
[[nodiscard]] std::string packed(const std::vector<std::int16_t>& values);
[[nodiscard]] std::string packed(const std::vector<std::int32_t>& values);

/// Bytes as letters, digits, + and / (RFC 4648).
[[nodiscard]] std::string base64(const std::string& bytes);

}  // namespace lv::page
