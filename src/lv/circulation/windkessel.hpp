#pragma once

#include "lv/circulation/signals.hpp"
#include "lv/circulation/valve.hpp"

#include <array>

namespace lv::circulation {

/// Three elements behind the aortic valve and a venous source before the mitral valve:
///
///   V' = Q_mv - Q_ao,          Q_mv = valve(p_ven - p),  Q_ao = valve(p - p_c) through R_ao + R_c
///   C p_c' = Q_ao - p_c/R_p,   p_ao = p_c + R_c Q_ao
///
/// States: V, p_c.
class Windkessel {
 public:
  static constexpr int size = 2;
  template <class T>
  using States = std::array<T, size>;

  Windkessel(const WindkesselParameters& parameters, const ValveParameters& valves)
      : p_(parameters), mitral_(p_.R_mv, valves), aortic_(p_.R_ao + p_.R_c, valves) {}

  [[nodiscard]] static States<double> start(const Start& s) { return {s.V_lv, s.p_ar_sys}; }

  /// Rates of change for the pressure of the ventricle [kPa].
  template <class T>
  [[nodiscard]] States<T> rates(double /*t*/, const States<T>& y, const T& p) const {
    const T Q_ao = aortic_.flow(T(p - y[1]));
    return {mitral_.flow(T(p_.p_ven - p)) - Q_ao, (Q_ao - y[1] / p_.R_p) / p_.C};
  }

  [[nodiscard]] Signals signals(double /*t*/, const States<double>& y, double p) const {
    const double Q_ao = aortic_.flow(p - y[1]);
    return {.volume = y[0],
            .pressure = p,
            .filling_pressure = p_.p_ven,
            .aortic_pressure = y[1] + p_.R_c * Q_ao,
            .mitral_gradient = p_.p_ven - p,
            .aortic_gradient = p - y[1],
            .mitral_flow = mitral_.flow(p_.p_ven - p),
            .aortic_flow = Q_ao,
            .others = {y[1]}};
  }

  [[nodiscard]] static std::vector<Column> columns() { return {{"arterial_pressure", "mmHg"}}; }

 private:
  WindkesselParameters p_;
  Valve mitral_, aortic_;
};

}  // namespace lv::circulation
