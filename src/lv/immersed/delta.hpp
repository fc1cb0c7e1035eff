#pragma once

#include <array>
#include <cmath>

namespace lv::immersed {

/// Regularised delta functions, products of one-dimensional kernels over the axes (in units of the
/// mesh width).
enum class Kernel {
  /// Peskin's 4-point kernel (Acta Numerica 11:479, 2002), the paper's.
  peskin4,
  /// B-splines, cubic along a velocity component's own axis and quadratic along the others: the
  /// velocity interpolated
  /// from a discretely divergence-free field is then divergence-free at every point.
  composite_bspline
};

/// Kernel weights of one point along one axis: grid points first .. first + 3.
struct AxisWeights {
  int first;
  std::array<double, 4> weight;
};

/// Peskin's kernel for a point at grid coordinate s (grid points at whole numbers):
///   phi(r) = (3 - 2|r| + sqrt(1 + 4|r| - 4r^2))/8 for |r| <= 1, (5 - 2|r| - sqrt(-7 + 12|r| - 4r^2))/8 for |r| <= 2.
inline AxisWeights peskin4(double s) {
  const double cell = std::floor(s);
  const double r = s - cell;
  const double root = std::sqrt(1.0 + 4.0 * r * (1.0 - r));
  const double low = 3.0 - 2.0 * r;
  const double high = 1.0 + 2.0 * r;
  return {
      static_cast<int>(cell) - 1,
      {0.125 * (low - root), 0.125 * (low + root), 0.125 * (high + root), 0.125 * (high - root)}};
}

inline AxisWeights cubic_bspline(double s) {
  const double cell = std::floor(s);
  const double r = s - cell;
  const double q = 1.0 - r;
  return {static_cast<int>(cell) - 1,
          {q * q * q / 6.0, 2.0 / 3.0 - r * r + 0.5 * r * r * r,
           2.0 / 3.0 - q * q + 0.5 * q * q * q, r * r * r / 6.0}};
}

inline AxisWeights quadratic_bspline(double s) {
  const double nearest = std::floor(s + 0.5);
  const double r = s - nearest;
  return {static_cast<int>(nearest) - 1,
          {0.5 * (0.5 - r) * (0.5 - r), 0.75 - r * r, 0.5 * (0.5 + r) * (0.5 + r), 0.0}};
}

/// Weights along an axis; `own_axis` when the axis is the one of the velocity component.
inline AxisWeights axis_weights(Kernel kernel, double s, bool own_axis) {
  if (kernel == Kernel::peskin4)
    return peskin4(s);
  return own_axis ? cubic_bspline(s) : quadratic_bspline(s);
}

}  // namespace lv::immersed
