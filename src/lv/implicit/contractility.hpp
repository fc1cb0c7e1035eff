#pragma once

#include "lv/material/active_law.hpp"
#include "lv/material/calcium.hpp"
#include "lv/material/steady_tension.hpp"

#include <functional>

namespace lv::implicit {

using material::Tension;

/// Active tension without time: at activation 0 the muscle rests, at 1 it is fully active.
///
///   T = (1 - s) T_steady(lambda, Ca_0) + s T_steady(lambda, Ca_max)   (a law with kinetics), or
///   T = s T_max                                                      whatever the stretch
class Contractility {
 public:
  /// The steady states of the law at resting calcium and at its peak, or the prescribed tension.
  Contractility(const material::ActiveLaw& law, const material::Calcium& calcium)
      : rest_(held(law, calcium.Ca_0, 0.0)), peak_(held(law, calcium.Ca_max, 1.0)) {}

  [[nodiscard]] Tension at(double stretch, double activation) const {
    const double s = activation;
    const Tension rest = rest_(stretch);
    const Tension peak = peak_(stretch);
    return {(1.0 - s) * rest.value + s * peak.value,
            (1.0 - s) * rest.derivative + s * peak.derivative};
  }

 private:
  using OfStretch = std::function<Tension(double stretch)>;

  static OfStretch held(const material::ActiveLaw& law, double Ca, double activation) {
    if (const auto* prescribed = std::get_if<material::PrescribedTension>(&law))
      return [T = activation * prescribed->T_max](double) { return Tension{T, 0.0}; };
    if (const auto* land = std::get_if<material::Land2017>(&law))
      return [law = *land, Ca](double stretch) { return law.steady_tension(Ca, stretch); };
    return [table = material::SteadyTension(std::get<material::NiedererHunterSmith>(law), Ca)](
               double stretch) { return table.at(stretch); };
  }

  OfStretch rest_, peak_;
};

}  // namespace lv::implicit
