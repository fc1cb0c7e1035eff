#pragma once

#include <string>
#include <vector>

namespace lv::drawing {

struct Range {
  double low = 0.0;
  double high = 1.0;
};

/// Round numbers on an axis: multiples of 1, 2 or 5 times a power of ten, three to six steps.
struct Ticks {
  Range range;  ///< of the axis
  std::vector<double> values;
  std::vector<std::string> labels;  ///< with as many decimals as the step needs
};

/// The round numbers inside `range`.
[[nodiscard]] Ticks ticks_within(const Range& range);

/// The largest of 1, 2, 5, 10, ... that is not above `value`.
[[nodiscard]] double round_down(double value);

/// `value` with a true minus sign.
[[nodiscard]] std::string number(double value, int decimals);

}  // namespace lv::drawing
