#pragma once

#include <Eigen/Core>

#include <cmath>

namespace lv {

/// A number with its derivatives with respect to N others, for functions that are written once for
/// numbers and for these: forward differentiation, exact to rounding.
template <int N>
struct Dual {
  using Slope = Eigen::Matrix<double, N, 1>;

  double value = 0.0;
  Slope slope = Slope::Zero();

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT(google-explicit-constructor): numbers are constants
  Dual(double v, const Slope& s) : value(v), slope(s) {}

  /// The variable of an index.
  static Dual variable(double v, int index = 0) { return {v, Slope::Unit(index)}; }

  friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.slope + b.slope};
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.slope - b.slope};
  }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.slope + b.value * a.slope};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double ratio = a.value / b.value;
    return {ratio, (a.slope - ratio * b.slope) / b.value};
  }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return {root, a.slope / (2.0 * root)};
  }
  friend Dual exp(const Dual& a) {
    const double e = std::exp(a.value);
    return {e, e * a.slope};
  }
  friend Dual atan(const Dual& a) {
    return {std::atan(a.value), a.slope / (1.0 + a.value * a.value)};
  }
  friend Dual select(bool condition, const Dual& yes, const Dual& no) {
    return condition ? yes : no;
  }
  friend Dual maximum(const Dual& a, const Dual& b) { return a < b ? b : a; }
  friend Dual minimum(const Dual& a, const Dual& b) { return b < a ? b : a; }
};

}  // namespace lv
