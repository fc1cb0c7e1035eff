#pragma once

namespace lv::material {

/// Intracellular calcium, the same everywhere, from the start of activation on (A.1):
///
///   [Ca](t) = Ca_0 + (Ca_max - Ca_0) (t/tau) exp(1 - t/tau),     peak Ca_max at t = tau.
///
/// `hold`: stays at its peak from t = tau on (the paper's systole: "raised to its peak ... until a
/// steady state"). `transient`: decays as (A.1) says.
struct Calcium {
  enum class Mode { hold, transient };

  Mode mode = Mode::hold;
  double Ca_0 = 0.01;   ///< [uM]
  double Ca_max = 1.0;  ///< [uM]
  double tau = 0.06;    ///< [s]

  /// [Ca] at time t after the start of activation; Ca_0 before it.
  [[nodiscard]] double at(double t) const;
};

}  // namespace lv::material
