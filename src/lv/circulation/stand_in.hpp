#pragma once

#include "lv/circulation/beat_measures.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace lv::circulation {

/// What is known of a wall besides one of its beats.
struct PassiveFilling {
  double pressure = 0.0;  ///< at the end-diastolic volume [kPa]
  double exponent = 6.0;  ///< d ln p/d ln V there
};

/// A ventricle of lumped elements that beats as a wall was seen to beat, and nearly as the wall
/// would under other loads and with another contractility c:
///
///   p(t, V) = p_pas(V) + c e(t) (V - V_d),    p_pas(V) = p_ed exp(n (V/V_ed - 1)),
///
/// where e(t) is such that p and V of the beat fulfil it with c = 1 (the passive part as in
/// PassiveFilling, the active one an elastance with the volume intercept V_d: Suga and Sagawa,
/// Circ. Res. 35:117, 1974). V_d is a tenth of V_ed, as end-systolic relations of the wall have it,
/// and at most half of the least volume.
class StandIn {
 public:
  /// Of the samples of a whole beat, and its end-diastolic volume [mm^3].
  StandIn(std::span<const Sample> beat, double end_diastolic_volume, const PassiveFilling& filling);

  /// The same with this times the active tension.
  [[nodiscard]] StandIn with_contractility(double factor) const;

  /// [kPa]
  template <class T>
  [[nodiscard]] T pressure(double t, const T& volume) const {
    using std::exp;
    return filling_.pressure * exp(T(filling_.exponent * (volume / V_ed_ - 1.0))) +
           contractility_ * elastance(t) * (volume - V_d_);
  }

 private:
  /// e(t) [kPa/mm^3].
  [[nodiscard]] double elastance(double t) const;

  PassiveFilling filling_;
  double V_ed_, V_d_;
  double contractility_ = 1.0;
  std::vector<double> times_, elastances_;  ///< times from the beat's beginning [s]
};

}  // namespace lv::circulation
