#pragma once

#include "lv/base/parallel.hpp"

#include <array>
#include <chrono>

namespace lv::heartbeat {

/// Seconds of one clock for all ranks, which must agree on what to do next. Collective.
[[nodiscard]] inline double wall_clock() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  std::array<double, 1> seconds{std::chrono::duration<double>(now).count()};
  parallel::broadcast(seconds);
  return seconds[0];
}

/// Does things at regular wall-clock intervals.
class Timer {
 public:
  explicit Timer(double interval) : interval_(interval), last_(wall_clock()) {}

  [[nodiscard]] bool due(double now) {
    if (now - last_ < interval_)
      return false;
    last_ = now;
    return true;
  }

 private:
  double interval_;
  double last_;
};

}  // namespace lv::heartbeat
