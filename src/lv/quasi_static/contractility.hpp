#pragma once

#include "lv/material/steady_tension.hpp"

#include <optional>

namespace lv::quasi_static {

/// Tension at one point and how it changes with fibre stretch.
struct Tension {
  double value = 0.0;       ///< T [kPa]
  double derivative = 0.0;  ///< dT/dlambda at the same activation [kPa]
};

/// Active tension without time: at activation 0 the muscle rests, at 1 it is fully active.
///
///   T = (1 - s) T_steady(lambda, Ca_0) + s T_steady(lambda, Ca_max)   (Appendix A at rest), or
///   T = s T_max                                                      whatever the stretch
class Contractility {
 public:
  /// The steady states of the law at resting and at held calcium [uM].
  Contractility(const material::NiedererHunterSmith& law, double Ca_0, double Ca_max)
      : rest_(std::in_place, law, Ca_0), peak_(std::in_place, law, Ca_max) {}

  /// A prescribed tension [kPa].
  explicit Contractility(double T_max) : T_max_(T_max) {}

  [[nodiscard]] Tension at(double stretch, double activation) const {
    const double s = activation;
    if (!peak_)
      return {s * T_max_, 0.0};
    return {(1.0 - s) * rest_->tension(stretch) + s * peak_->tension(stretch),
            (1.0 - s) * rest_->derivative(stretch) + s * peak_->derivative(stretch)};
  }

 private:
  double T_max_ = 0.0;
  std::optional<material::SteadyTension> rest_, peak_;
};

}  // namespace lv::quasi_static
