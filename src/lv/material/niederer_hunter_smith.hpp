#pragma once

#include "lv/base/tensor.hpp"

#include <array>

namespace lv::material {

/// State of the contractile machinery at one point.
template <class T>
struct Sarcomere {
  T Ca_trpn = T(0.0);                          ///< calcium bound to troponin [uM]
  T z = T(0.0);                                ///< available actin sites [-]
  std::array<T, 3> Q{T(0.0), T(0.0), T(0.0)};  ///< fading memory [-]
  T stretch = T(1.0);                          ///< fibre stretch lambda_f [-]
  T tension = T(0.0);                          ///< T [kPa]

  /// All numbers, in the order of a checkpoint.
  auto fields() { return std::array{&Ca_trpn, &z, &Q[0], &Q[1], &Q[2], &stretch, &tension}; }
};

/// Active tension of Niederer, Hunter & Smith (Biophys. J. 90:1697-1722, 2006) as in the paper's
/// Appendix A.
///
/// Guards, none of them in the paper's text (its code and the CellML model have them):
///  - the stretch is limited to [0.8, 1.15] where it sets binding, unbinding and overlap (A.5)-(A.7), not in the rate of
///    (A.11). The paper's own maximum tension, 536 kPa for T_ref = 309.1 kPa, means the limit 1.15;
///  - unbinding never slows below a tenth of its tension-free rate, since (A.3) changes sign at T = gamma T_ref, which
///    fast lengthening reaches;
///  - the tension is never negative, which (A.10) makes it when shortening outruns 9.5 per second.
struct NiedererHunterSmith {
  double T_scale = 3.0;  ///< strength of contraction [-] (section 3.1, healthy subject)
  double T_ref_unscaled =
      56.2;  ///< tension at full activation and resting length, T_scale = 1 [kPa]
  double a = 0.35;
  std::array<double, 3> A{-29.0, 138.0, 129.0};
  std::array<double, 3> alpha{30.0, 130.0, 625.0};  ///< [1/s]
  double alpha_0 = 8.0;                             ///< [1/s]
  double alpha_r1 = 2.0;                            ///< [1/s]
  double alpha_r2 = 1.75;                           ///< [1/s]
  double beta_0 = 4.9;
  double beta_1 = -4.0;
  double Ca_50ref = 1.05;     ///< [uM]
  double Ca_trpn_max = 70.0;  ///< [uM]
  double gamma = 2.0;
  double k_on = 100.0;       ///< [1/(uM s)]
  double k_off_ref = 200.0;  ///< [1/s]
  double K_z = 0.15;
  double z_p = 0.85;
  double stretch_min = 0.8;    ///< guard, see above
  double stretch_max = 1.15;   ///< guard, see above
  double unbinding_min = 0.1;  ///< guard, see above

  static constexpr int n = 3;    ///< cooperativity of binding (A.4)
  static constexpr int n_r = 3;  ///< of relaxation

  template <class T>
  using State = Sarcomere<T>;

  /// T_ref = T_scale x 56.2 kPa.
  [[nodiscard]] double T_ref() const { return T_scale * T_ref_unscaled; }

  /// [Ca]_trpn,50 / [Ca]_trpn,max at a stretch (A.5) [-].
  template <class T>
  [[nodiscard]] T half_binding(const T& stretch) const;

  /// Isometric tension at z = z_max, T_ref (1 + beta_0 (lambda - 1)) (A.6) [kPa].
  template <class T>
  [[nodiscard]] T overlap_tension(const T& stretch) const;

  /// z_max(lambda) (A.7)-(A.9) [-].
  template <class T>
  [[nodiscard]] T z_max(const T& stretch) const;

  /// T / T_0 as a function of Q = sum Q_i (A.10) [-].
  template <class T>
  [[nodiscard]] T fading_memory(const T& Q) const;

  /// T_0 from the state's z and stretch (A.6) [kPa].
  template <class T>
  [[nodiscard]] T isometric_tension(const Sarcomere<T>& state) const {
    return overlap_tension(state.stretch) * state.z / z_max(state.stretch);
  }

  /// T from the state's z, Q and stretch (A.6), (A.10) [kPa].
  template <class T>
  [[nodiscard]] T tension(const Sarcomere<T>& state) const {
    return isometric_tension(state) * fading_memory(T(state.Q[0] + state.Q[1] + state.Q[2]));
  }

  /// k_off (A.3), never below `unbinding_min` of its tension-free rate [1/s]. Muscle without
  /// strength (T_ref = 0) unbinds as without tension.
  template <class T>
  [[nodiscard]] T unbinding_rate(const T& tension) const {
    const double per_tension = T_ref() > 0.0 ? 1.0 / (gamma * T_ref()) : 0.0;
    return k_off_ref * maximum(T(1.0 - per_tension * tension), T(unbinding_min));
  }

  /// dT/dlambda at fixed time over T_0, at Q = 0: (1 + a) sum A_i [-]. Stretching faster than the
  /// fading memory forgets meets this stiffness.
  [[nodiscard]] double instantaneous_stiffness() const { return (1.0 + a) * (A[0] + A[1] + A[2]); }

  /// dT/dlambda of a sudden stretch without change of overlap [kPa].
  template <class T>
  [[nodiscard]] T sudden_stiffness(const Sarcomere<T>& state) const {
    return instantaneous_stiffness() * isometric_tension(state);
  }

  /// One step of length dt [s] to the new stretch, calcium [uM] going from Ca_before to Ca_after. Q
  /// is integrated exactly for the stretch rate [1/s], constant over this very step; binding and
  /// sites by Heun's rule. Second order in dt.
  template <class T, class Calcium>
  void advance(Sarcomere<T>& state, const T& stretch, const T& stretch_rate,
               const Calcium& Ca_before, const Calcium& Ca_after, double dt) const;

  /// The same, with the rate that leads from the state's stretch to the new one.
  template <class T, class Calcium>
  void advance(Sarcomere<T>& state, const T& stretch, const Calcium& Ca_before,
               const Calcium& Ca_after, double dt) const {
    advance(state, stretch, T((stretch - state.stretch) / dt), Ca_before, Ca_after, dt);
  }

  /// The steady state at constant calcium and stretch.
  [[nodiscard]] Sarcomere<double> steady_state(double Ca, double stretch) const;

 private:
  template <class T>
  struct Rates {
    T Ca_trpn;
    T z;
  };
  template <class T>
  [[nodiscard]] T limited(const T& stretch) const {
    return minimum(maximum(stretch, T(stretch_min)), T(stretch_max));
  }
  /// (A.2)-(A.4).
  template <class T, class Calcium>
  [[nodiscard]] Rates<T> rates(const Sarcomere<T>& state, const Calcium& Ca) const;
};

template <class T>
T NiedererHunterSmith::half_binding(const T& stretch) const {
  const T elongation = limited(stretch) - 1.0;
  const T Ca_50 = Ca_50ref * (1.0 + beta_1 * elongation);
  const T unbinding = (k_off_ref / k_on) * (1.0 - (1.0 + beta_0 * elongation) / (2.0 * gamma));
  return Ca_50 / (Ca_50 + unbinding);
}

template <class T>
T NiedererHunterSmith::overlap_tension(const T& stretch) const {
  return T_ref() * (1.0 + beta_0 * (limited(stretch) - 1.0));
}

template <class T>
T NiedererHunterSmith::z_max(const T& stretch) const {
  const double z_pn = power(z_p, n_r);
  const double K_zn = power(K_z, n_r);
  const double K_1 = alpha_r2 * power(z_p, n_r - 1) * n_r * K_zn / power(z_pn + K_zn, 2);
  const double K_2 = alpha_r2 * z_pn / (z_pn + K_zn) * (1.0 - n_r * K_zn / (z_pn + K_zn));
  const T binding = alpha_0 / power(half_binding(stretch), n);
  return (binding - K_2) / (alpha_r1 + K_1 + binding);
}

template <class T>
T NiedererHunterSmith::fading_memory(const T& Q) const {
  const T shortening = (1.0 + a * Q) / (1.0 - Q);
  const T lengthening = (1.0 + (2.0 + a) * Q) / (1.0 + Q);
  return maximum(select(Q < T(0.0), shortening, lengthening), T(0.0));
}

template <class T, class Calcium>
NiedererHunterSmith::Rates<T> NiedererHunterSmith::rates(const Sarcomere<T>& state,
                                                         const Calcium& Ca) const {
  const T k_off = unbinding_rate(state.tension);
  const T bound = state.Ca_trpn / (Ca_trpn_max * half_binding(state.stretch));
  const T z_n = power(state.z, n_r);
  return {k_on * Ca * (Ca_trpn_max - state.Ca_trpn) - k_off * state.Ca_trpn,
          alpha_0 * power(bound, n) * (1.0 - state.z) - alpha_r1 * state.z -
              alpha_r2 * z_n / (z_n + power(K_z, n_r))};
}

template <class T, class Calcium>
void NiedererHunterSmith::advance(Sarcomere<T>& state, const T& stretch, const T& stretch_rate,
                                  const Calcium& Ca_before, const Calcium& Ca_after,
                                  double dt) const {
  const Rates<T> before = rates(state, Ca_before);
  Sarcomere<T> next = state;
  for (int i = 0; i < 3; ++i) {
    const double decay = std::exp(-alpha[i] * dt);
    next.Q[i] = decay * state.Q[i] + (A[i] * (1.0 - decay) / alpha[i]) * stretch_rate;
  }
  next.stretch = stretch;
  next.Ca_trpn = state.Ca_trpn + dt * before.Ca_trpn;
  next.z = state.z + dt * before.z;
  next.tension = tension(next);

  const Rates<T> after = rates(next, Ca_after);
  next.Ca_trpn = state.Ca_trpn + 0.5 * dt * (before.Ca_trpn + after.Ca_trpn);
  next.z = state.z + 0.5 * dt * (before.z + after.z);
  next.tension = tension(next);
  state = next;
}

}  // namespace lv::material
