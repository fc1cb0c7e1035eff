#pragma once

#include <cmath>

namespace lv {

/// How long after the latest beginning of a period, one of which is at 0, a time is: t - T
/// floor(t/T), from 0 to less than T; of negative times too.
[[nodiscard]] inline double time_in_period(double t, double period) {
  return t - period * std::floor(t / period);
}

}  // namespace lv
