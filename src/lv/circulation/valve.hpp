#pragma once

#include "lv/circulation/parameters.hpp"

#include <cmath>
#include <numbers>

namespace lv::circulation {

/// A valve with the resistance R when open and R_closed when closed. Its flow Q depends on the
/// pressure before it less that behind it, x:
///
///   quadratic    Q = x/R_closed for x < -w/2, x/R for x > w/2, between them the parabola with
///                the same ends and slopes, for a width w: monotone, convex and of class C1
///   arctangent   Q = x/R_x with log R_x between log R_closed and log R by the share
///                1/2 + atan(100 pi x/mmHg)/pi (Regazzoni et al. 2022), for comparison
class Valve {
 public:
  Valve(double open_resistance, const ValveParameters& p)
      : open_(1.0 / open_resistance), closed_(1.0 / p.closed_resistance), p_(p) {}

  /// Q [mm^3/s] for x [kPa].
  template <class T>
  [[nodiscard]] T flow(const T& x) const {
    return p_.law == ValveLaw::quadratic ? quadratic(x) : arctangent(x);
  }

 private:
  template <class T>
  [[nodiscard]] T quadratic(const T& x) const {
    const double half = 0.5 * p_.smoothing;
    if (x < T(-half))
      return closed_ * x;
    if (T(half) < x)
      return open_ * x;
    const T y = x + half;
    return closed_ * x + ((open_ - closed_) / (4.0 * half)) * y * y;
  }

  template <class T>
  [[nodiscard]] T arctangent(const T& x) const {
    using std::atan;
    using std::exp;
    constexpr double pi = std::numbers::pi;
    const T share = 0.5 + atan(T((100.0 * pi / units::mmHg) * x)) / pi;
    return closed_ * exp(T(std::log(open_ / closed_) * share)) * x;
  }

  double open_, closed_;  ///< conductances [mm^3/(kPa s)]
  ValveParameters p_;
};

}  // namespace lv::circulation
