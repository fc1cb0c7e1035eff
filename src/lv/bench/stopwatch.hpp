#pragma once

#include "lv/base/median.hpp"
#include "lv/base/parallel.hpp"

#include <chrono>
#include <utility>
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
  return median(std::move(times));
}

}  // namespace lv::bench
