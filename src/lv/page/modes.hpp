#pragma once

#include "lv/page/wall_series.hpp"

#include <cstdint>
#include <vector>

namespace lv::page {

/// A field over time as a few shapes, each with a course over time:
///
///   A(t, i) = offset + sum_k course_k(t) step shape_k(i)
///
/// The shapes are the leading eigenvectors of the series' covariance (proper orthogonal
/// decomposition), in whole steps. A beat of any number of frames takes some ten of them.
struct Modes {
  double offset = 0.0;  ///< mean of the series
  double step = 1.0;
  std::vector<std::vector<double>> courses;       ///< per shape, a number per time
  std::vector<std::vector<std::int16_t>> shapes;  ///< per shape, a number per place
  double largest_error = 0.0;                     ///< over all times and places
};

/// As few shapes as keep every value within `tolerance`, or as 16 bits allow.
[[nodiscard]] Modes modes(const NodalSeries& series, double tolerance);

}  // namespace lv::page
