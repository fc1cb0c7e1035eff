#pragma once

#include "lv/base/parallel.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

namespace lv::bench {

/// Median time of `work` over `repetitions` after one run to warm up; of each run the slowest
/// rank's time counts [s].
template <class Work>
double median_seconds(const Work& work, int repetitions = 7) {
  work();
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    parallel::barrier();
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    times.push_back(parallel::max(elapsed.count()));
  }
  std::nth_element(times.begin(), times.begin() + repetitions / 2, times.end());
  return times[static_cast<std::size_t>(repetitions) / 2];
}

}  // namespace lv::bench
