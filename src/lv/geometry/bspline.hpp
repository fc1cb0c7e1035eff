#pragma once

#include <array>
#include <vector>

namespace lv::geometry {

/// Uniform knots of cubic B-splines on [0, end].
///
/// Clamped: the first and the last basis function are 1 at their ends; intervals + 3 functions.
/// Periodic: function j is centred at knot j, and j + intervals means j; `intervals` functions.
class CubicBasis {
 public:
  enum class Ends { clamped, periodic };

  CubicBasis(Ends ends, int intervals, double end);

  /// The four basis functions that are not zero at a point, with first and second derivatives.
  struct Local {
    std::array<int, 4> index;
    std::array<double, 4> value, slope, curvature;
  };
  [[nodiscard]] Local at(double x) const;

  [[nodiscard]] int size() const;
  [[nodiscard]] int intervals() const { return intervals_; }
  [[nodiscard]] double end() const { return end_; }
  [[nodiscard]] double step() const { return end_ / intervals_; }

 private:
  Ends ends_;
  int intervals_;
  double end_;
  std::vector<double> knots_;  ///< three more than the intervals' on either side
};

}  // namespace lv::geometry
