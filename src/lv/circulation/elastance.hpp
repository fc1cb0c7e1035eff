#pragma once

#include "lv/base/periodic.hpp"
#include "lv/circulation/parameters.hpp"

#include <cmath>
#include <numbers>

namespace lv::circulation {

/// A chamber's stiffness through beats of a period [s].
class Elastance {
 public:
  Elastance(const ElastanceParameters& parameters, double period)
      : p_(parameters), period_(period) {}

  /// E_B + E_A e(t) [kPa/mm^3].
  [[nodiscard]] double at(double t) const {
    const double s = time_in_period(t - p_.t_C, period_);
    constexpr double pi = std::numbers::pi;
    if (s < p_.T_C)
      return p_.E_B + p_.E_A * 0.5 * (1.0 - std::cos(pi * s / p_.T_C));
    if (s < p_.T_C + p_.T_R)
      return p_.E_B + p_.E_A * 0.5 * (1.0 + std::cos(pi * (s - p_.T_C) / p_.T_R));
    return p_.E_B;
  }

  /// The pressure of a volume [kPa].
  template <class T>
  [[nodiscard]] T pressure(double t, const T& volume) const {
    return at(t) * (volume - p_.V_0);
  }

 private:
  ElastanceParameters p_;
  double period_;
};

}  // namespace lv::circulation
