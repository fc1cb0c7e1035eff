#pragma once

namespace lv::material {

/// Intracellular calcium, the same everywhere, from the start of activation on:
///
///   alpha_function       Ca_0 + (Ca_max - Ca_0) (t/tau) exp(1 - t/tau)                        (A.1)
///   double_exponential   Ca_0 + (Ca_max - Ca_0) (exp(-t/t_2) - exp(-t/t_1))/b,
///                        b = exp(-t_p/t_2) - exp(-t_p/t_1),  t_p = ln(t_2/t_1)/(1/t_1 - 1/t_2)
///
/// Both peak at Ca_max, at t = tau and t = t_p. `hold`: stays at its peak from then on (the paper's
/// systole: "raised to its peak ... until a steady state"). `transient`: decays as they say.
struct Calcium {
  enum class Mode { hold, transient };
  enum class CurveShape { alpha_function, double_exponential };

  Mode mode = Mode::hold;
  double Ca_0 = 0.01;   ///< [uM]
  double Ca_max = 1.0;  ///< [uM]
  double tau = 0.06;    ///< [s]
  CurveShape shape = CurveShape::alpha_function;
  double t_1 = 0.04;  ///< of the rise [s]
  double t_2 = 0.22;  ///< of the decay, longer than t_1 [s]

  /// [Ca] at time t after the start of activation; Ca_0 before it.
  [[nodiscard]] double at(double t) const;

  /// When it peaks [s].
  [[nodiscard]] double peak_time() const;

 private:
  [[nodiscard]] double share(double t) const;  ///< of the way from Ca_0 to Ca_max
};

}  // namespace lv::material
