#pragma once

namespace lv::log {

/// How many warnings this process has said so far.
[[nodiscard]] int warnings();

}  // namespace lv::log
