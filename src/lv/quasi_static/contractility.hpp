#pragma once

#include "lv/material/active_law.hpp"
#include "lv/material/calcium.hpp"
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
  /// The steady states of the law at resting calcium and at its peak, or the prescribed tension.
  Contractility(const material::ActiveLaw& law, const material::Calcium& calcium) {
    if (const auto* prescribed = std::get_if<material::PrescribedTension>(&law)) {
      T_max_ = prescribed->T_max;
      return;
    }
    const auto& kinetics = std::get<material::NiedererHunterSmith>(law);
    rest_.emplace(kinetics, calcium.Ca_0);
    peak_.emplace(kinetics, calcium.Ca_max);
  }

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
