#pragma once

#include "lv/bench/bench.hpp"

namespace lv::bench {

[[nodiscard]] Machine measure_machine();

/// The largest resident memory so far of all ranks together [B].
[[nodiscard]] double peak_memory();

}  // namespace lv::bench
