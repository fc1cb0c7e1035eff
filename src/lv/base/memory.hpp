#pragma once

#include <cstdint>
#include <string>

namespace lv {

/// Bytes that this process may still ask for: the least of what the machine has free, what its
/// control group leaves of its limit, and what this process's own limit (RLIMIT_AS) leaves.
[[nodiscard]] std::uintmax_t free_memory();

/// Throws RunError naming a file unless so many bytes are free.
void require_memory(const std::string& file, double bytes);

}  // namespace lv
