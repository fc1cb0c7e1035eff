#pragma once

#include "lv/base/tensor.hpp"
#include "lv/material/tension.hpp"

#include <array>
#include <cmath>

namespace lv::material {

/// State of human muscle at one point: the shares of troponin with calcium, of blocked actin sites
/// and of cross-bridges before (W) and after (S) their power stroke, and the strains of the latter.
template <class T>
struct CrossBridges {
  T CaTRPN = T(0.0);   ///< [-]
  T B = T(1.0);        ///< [-]
  T W = T(0.0);        ///< [-]
  T S = T(0.0);        ///< [-]
  T zeta_w = T(0.0);   ///< [-]
  T zeta_s = T(0.0);   ///< [-]
  T stretch = T(1.0);  ///< fibre stretch lambda_f [-]
  T tension = T(0.0);  ///< T [kPa]

  /// All numbers, in the order of a checkpoint.
  auto fields() { return std::array{&CaTRPN, &B, &W, &S, &zeta_w, &zeta_s, &stretch, &tension}; }
};

/// Active tension of Land, Park-Holohan, Smith, dos Remedios, Kentish & Niederer (J. Mol. Cell.
/// Cardiol. 106:68-83, 2017): human muscle at 37 degrees, with the constants for a whole heart.
///
///   CaTRPN' = k_TRPN ((Ca/Ca_50)^2 (1 - CaTRPN) - CaTRPN),   Ca_50 = Ca_50ref + beta_1 (min(lambda, 1.2) - 1)
///   B' = k_b min(100, CaTRPN^-5/2) U - k_u CaTRPN^5/2 B,     U = 1 - B - S - W
///   W' = k_uw U - (k_wu + k_ws + gamma_w |zeta_w|) W
///   S' = k_ws W - (k_su + gamma_su) S,                       gamma_su = gamma_s (zeta_s > 0: zeta_s; < -1: -zeta_s - 1)
///   zeta_i' = A lambda' - c_i zeta_i
///   T = h(lambda) (T_ref/r_s) ((1 + zeta_s) S + zeta_w W)
///   h = max(0, 1 + beta_0 (l + min(l, 0.87) - 1.87)),        l = min(lambda, 1.2)
///
/// T is negative while fast shortening pushes the cross-bridges back.
struct Land2017 {
  double T_ref = 120.0;     ///< tension at full activation and resting length [kPa]
  double Ca_50ref = 0.805;  ///< [uM]
  double beta_0 = 2.3;
  double beta_1 = -2.4;  ///< [uM]
  double TRPN_50 = 0.35;
  double r_s = 0.25;       ///< share of cross-bridges after the power stroke at full activation
  double r_w = 0.5;        ///< share before it of the rest
  double k_TRPN = 100.0;   ///< [1/s]
  double k_u = 1000.0;     ///< [1/s]
  double k_uw = 182.0;     ///< [1/s]
  double k_ws = 12.0;      ///< [1/s]
  double gamma_s = 8.5;    ///< [1/s]
  double gamma_w = 615.0;  ///< [1/s]
  double phi = 2.23;
  double A_eff = 25.0;

  static constexpr int n_TRPN = 2;        ///< cooperativity of calcium and troponin
  static constexpr int n_Tm = 5;          ///< of tropomyosin
  static constexpr double longest = 1.2;  ///< a longer stretch acts like this one

  template <class T>
  using State = CrossBridges<T>;

  /// h(lambda) T_ref/r_s [kPa].
  template <class T>
  [[nodiscard]] T overlap_tension(const T& stretch) const {
    const T l = minimum(stretch, T(longest));
    return (T_ref / r_s) * maximum(T(1.0 + beta_0 * (l + minimum(l, T(0.87)) - 1.87)), T(0.0));
  }

  /// T from a state [kPa].
  template <class T>
  [[nodiscard]] T tension(const CrossBridges<T>& s) const {
    return overlap_tension(s.stretch) * ((1.0 + s.zeta_s) * s.S + s.zeta_w * s.W);
  }

  /// dT/dlambda of a sudden stretch without change of overlap, h (T_ref/r_s) A (S + W) [kPa].
  template <class T>
  [[nodiscard]] T sudden_stiffness(const CrossBridges<T>& s) const {
    return overlap_tension(s.stretch) * (A() * (s.S + s.W));
  }

  /// One step of length dt [s] to the new stretch, calcium [uM] going from Ca_before to Ca_after,
  /// for a stretch rate [1/s] that is constant over this very step. zeta is integrated exactly,
  /// CaTRPN for the middle's coefficients, the rest by the implicit midpoint rule. Second order in
  /// dt, and stable whatever dt.
  template <class T, class Calcium>
  void advance(CrossBridges<T>& state, const T& stretch, const T& stretch_rate,
               const Calcium& Ca_before, const Calcium& Ca_after, double dt) const;

  /// The same, with the rate that leads from the state's stretch to the new one.
  template <class T, class Calcium>
  void advance(CrossBridges<T>& state, const T& stretch, const Calcium& Ca_before,
               const Calcium& Ca_after, double dt) const {
    advance(state, stretch, T((stretch - state.stretch) / dt), Ca_before, Ca_after, dt);
  }

  /// The steady state at constant calcium and stretch, which knows no rates.
  template <class T>
  [[nodiscard]] CrossBridges<T> steady_state(double Ca, const T& stretch) const;

  /// The steady tension and its slope.
  [[nodiscard]] Tension steady_tension(double Ca, double stretch) const;

 private:
  [[nodiscard]] double A() const { return A_eff * r_s / ((1.0 - r_s) * r_w + r_s); }
  [[nodiscard]] double c_w() const { return phi * k_uw * (1.0 - r_w) / r_w; }
  [[nodiscard]] double c_s() const { return phi * k_ws * (1.0 - r_s) * r_w / r_s; }
  [[nodiscard]] double k_wu() const { return k_uw * (1.0 / r_w - 1.0) - k_ws; }
  [[nodiscard]] double k_su() const { return k_ws * r_w * (1.0 / r_s - 1.0); }
  /// k_b/k_u: half of the sites are blocked at CaTRPN = TRPN_50.
  [[nodiscard]] double blocking() const {
    return 0.5 * power(TRPN_50, n_Tm) / (0.5 - 0.5 * r_s - 0.5 * (1.0 - r_s) * r_w);
  }
  /// (Ca/Ca_50)^n_TRPN [-].
  template <class T, class Calcium>
  [[nodiscard]] T calcium_drive(const Calcium& Ca, const T& stretch) const {
    return power(T(Ca / (Ca_50ref + beta_1 * (minimum(stretch, T(longest)) - 1.0))), n_TRPN);
  }
  /// CaTRPN^(n_Tm/2); calcium is never quite gone, so that its inverse is a number.
  template <class T>
  [[nodiscard]] static T unblocking(const T& CaTRPN) {
    using std::sqrt;
    const T c = maximum(CaTRPN, T(1e-12));
    return power(c, 2) * sqrt(c);
  }
  /// zeta after a time t [s].
  template <class T>
  [[nodiscard]] T distorted(const T& zeta, double c, const T& stretch_rate, double t) const {
    const double decay = std::exp(-c * t);
    return decay * zeta + (A() * (1.0 - decay) / c) * stretch_rate;
  }
  template <class T>
  void advance_sites(CrossBridges<T>& state, const T& CaTRPN, const T& zeta_w, const T& zeta_s,
                     double dt) const;
};

/// The implicit midpoint rule is linear in B, W, S and U of the middle: each of the first three is
/// p + q U, and they sum to 1 - U.
template <class T>
void Land2017::advance_sites(CrossBridges<T>& state, const T& CaTRPN, const T& zeta_w,
                             const T& zeta_s, double dt) const {
  const double h = 0.5 * dt;
  const T unblock = unblocking(CaTRPN);
  const T block = k_u * blocking() * minimum(T(1.0 / unblock), T(100.0));
  const T gamma_wu = gamma_w * maximum(zeta_w, T(-zeta_w));
  const T gamma_su = gamma_s * (maximum(zeta_s, T(0.0)) + maximum(T(-zeta_s - 1.0), T(0.0)));
  const T of_B = 1.0 / (1.0 + h * k_u * unblock);
  const T of_W = 1.0 / (1.0 + h * (k_wu() + k_ws + gamma_wu));
  const T of_S = 1.0 / (1.0 + h * (k_su() + gamma_su));
  const T p_B = state.B * of_B;
  const T q_B = h * block * of_B;
  const T p_W = state.W * of_W;
  const T q_W = h * k_uw * of_W;
  const T p_S = (state.S + h * k_ws * p_W) * of_S;
  const T q_S = h * k_ws * q_W * of_S;
  const T U = (1.0 - p_B - p_W - p_S) / (1.0 + q_B + q_W + q_S);
  state.B = 2.0 * (p_B + q_B * U) - state.B;
  state.W = 2.0 * (p_W + q_W * U) - state.W;
  state.S = 2.0 * (p_S + q_S * U) - state.S;
}

template <class T, class Calcium>
void Land2017::advance(CrossBridges<T>& state, const T& stretch, const T& stretch_rate,
                       const Calcium& Ca_before, const Calcium& Ca_after, double dt) const {
  using std::exp;
  const T middle = 0.5 * (state.stretch + stretch);
  const T drive = calcium_drive(Calcium(0.5 * (Ca_before + Ca_after)), middle);
  const T bound = drive / (1.0 + drive);
  const T half_decay = exp(T(-0.5 * dt * k_TRPN * (1.0 + drive)));
  const T CaTRPN = bound + (state.CaTRPN - bound) * half_decay;
  advance_sites(state, CaTRPN, distorted(state.zeta_w, c_w(), stretch_rate, 0.5 * dt),
                distorted(state.zeta_s, c_s(), stretch_rate, 0.5 * dt), dt);
  state.CaTRPN = bound + (CaTRPN - bound) * half_decay;
  state.zeta_w = distorted(state.zeta_w, c_w(), stretch_rate, dt);
  state.zeta_s = distorted(state.zeta_s, c_s(), stretch_rate, dt);
  state.stretch = stretch;
  state.tension = tension(state);
}

template <class T>
CrossBridges<T> Land2017::steady_state(double Ca, const T& stretch) const {
  CrossBridges<T> s;
  const T drive = calcium_drive(Ca, stretch);
  s.CaTRPN = drive / (1.0 + drive);
  const T unblock = unblocking(s.CaTRPN);
  const T B_of_U = blocking() * minimum(T(1.0 / unblock), T(100.0)) / unblock;
  const double W_of_U = r_w / (1.0 - r_w);
  const double S_of_U = r_s / ((1.0 - r_s) * (1.0 - r_w));
  const T U = 1.0 / (1.0 + W_of_U + S_of_U + B_of_U);
  s.B = B_of_U * U;
  s.W = W_of_U * U;
  s.S = S_of_U * U;
  s.stretch = stretch;
  s.tension = tension(s);
  return s;
}

}  // namespace lv::material
