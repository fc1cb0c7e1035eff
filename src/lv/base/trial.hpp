#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace lv {

/// Whether some work comes to its end: without a signal or an exception, within a minute, and with
/// no more than `memory` bytes besides what is in use. Libraries that read files of other programs
/// do not, on files that are damaged in certain ways; a child of this process tries first.
[[nodiscard]] bool survives(const std::function<void()>& work,
                            std::uintmax_t memory = std::uintmax_t{1} << 30U);

/// Throws InputError naming the file unless some work on it survives; an InputError of its own is
/// left to this process, which will run into it too.
void check_survives(const std::string& file, const std::function<void()>& work);

}  // namespace lv
