#pragma once

#include <filesystem>
#include <functional>

namespace lv {

/// How many processors this process may use: those of its affinity (taskset), or fewer where a
/// control group limits their time (containers). At least 1.
[[nodiscard]] int processors();

/// Processors that the limits of a control group and of all groups around it come to, rounded up;
/// 0 where there is none. `root` is where control groups are mounted, `group` the process's own
/// below it. Reads cpu.max (version 2) and cpu.cfs_quota_us with cpu.cfs_period_us (version 1).
[[nodiscard]] int quota(const std::filesystem::path& root, const std::filesystem::path& group);

/// Calls work(i) for i = 0..n-1, on as many threads as there are processors and the machine starts.
/// Once a call has thrown no other is begun, and its exception is thrown on; Interrupted too
/// (interrupt.hpp).
void in_threads(std::size_t n, const std::function<void(std::size_t)>& work);

}  // namespace lv
