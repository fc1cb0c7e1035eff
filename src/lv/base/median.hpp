#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lv {

/// The value in the middle of several, at least one; the upper of two.
[[nodiscard]] inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace lv
