#pragma once

#include "lv/base/check.hpp"
#include "lv/circulation/elastance.hpp"
#include "lv/circulation/signals.hpp"
#include "lv/circulation/valve.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace lv::circulation {

/// The closed loop of Regazzoni et al. (J. Comput. Phys. 457:111083, 2022): four chambers, of which
/// three are elastances and the left ventricle is whoever gives its pressure, and the arteries and
/// veins of body and lungs:
///
///   V_lv' = Q_mv - Q_av,  V_la' = Q_ven,pul - Q_mv,  V_ra' = Q_ven,sys - Q_tv,  V_rv' = Q_tv - Q_pv
///   C_ar p_ar' = Q_in - Q_ar,                   C_ven p_ven' = Q_ar - Q_ven
///   L_ar Q_ar' = p_ar - p_ven - R_ar Q_ar,      L_ven Q_ven' = p_ven - p_atrium - R_ven Q_ven
///
/// The blood in it, sum V + sum C p, stays what it is: it alone says how well the heart is filled
/// in the end, and the start only how it comes there.
class ClosedLoop {
 public:
  static constexpr int size = 12;
  enum Name {
    V_lv,
    V_la,
    V_ra,
    V_rv,
    p_ar_sys,
    p_ven_sys,
    p_ar_pul,
    p_ven_pul,
    Q_ar_sys,
    Q_ven_sys,
    Q_ar_pul,
    Q_ven_pul
  };
  template <class T>
  using States = std::array<T, size>;

  ClosedLoop(const ClosedLoopParameters& parameters, const ValveParameters& valves, double period)
      : p_(parameters),
        valve_(p_.valve_resistance, valves),
        la_(p_.left_atrium, period),
        ra_(p_.right_atrium, period),
        rv_(p_.right_ventricle, period) {}

  /// With as much blood as the parameters say, if the left ventricle's volume is known: that of a
  /// wall is not before it has been filled.
  [[nodiscard]] States<double> start(const Start& s) const {
    States<double> y{s.V_lv,     s.V_la,      s.V_ra,     s.V_rv,      s.p_ar_sys, s.p_ven_sys,
                     s.p_ar_pul, s.p_ven_pul, s.Q_ar_sys, s.Q_ven_sys, s.Q_ar_pul, s.Q_ven_pul};
    if (p_.blood > 0.0 && !std::isnan(s.V_lv))
      fill_to(p_.blood, y);
    return y;
  }

  /// Brings the blood to so much [mm^3] around the same left ventricle: what every other part holds
  /// beyond its volume without pressure, and every flow, is multiplied by the same factor. Throws
  /// InputError for less blood than all hold without pressure.
  void fill_to(double blood, States<double>& y) const {
    const States<double> slack{y[V_lv], p_.left_atrium.V_0, p_.right_atrium.V_0,
                               p_.right_ventricle.V_0};
    const double unstressed = slack[V_lv] + slack[V_la] + slack[V_ra] + slack[V_rv];
    if (blood <= unstressed)
      throw InputError(
          "circulation.closed_loop.blood",
          fmt::format("is {:.0f} ml, and the left ventricle ({:.0f} ml) and the other chambers "
                      "without pressure hold {:.0f} ml: nothing is left that would fill vessels",
                      blood / ml, y[V_lv] / ml, unstressed / ml),
          "Give it more; the default circulation holds 1618 ml");
    const double factor = (blood - unstressed) / (this->blood(y) - unstressed);
    for (int i = V_la; i < size; ++i)
      y[i] = slack[i] + factor * (y[i] - slack[i]);
  }

  /// Rates of change for the pressure of the left ventricle [kPa].
  template <class T>
  [[nodiscard]] States<T> rates(double t, const States<T>& y, const T& p) const {
    const T p_la = la_.pressure(t, y[V_la]);
    const T p_ra = ra_.pressure(t, y[V_ra]);
    const T p_rv = rv_.pressure(t, y[V_rv]);
    const T Q_mv = valve_.flow(T(p_la - p));
    const T Q_av = valve_.flow(T(p - y[p_ar_sys]));
    const T Q_tv = valve_.flow(T(p_ra - p_rv));
    const T Q_pv = valve_.flow(T(p_rv - y[p_ar_pul]));
    States<T> rate;
    rate[V_lv] = Q_mv - Q_av;
    rate[V_la] = y[Q_ven_pul] - Q_mv;
    rate[V_ra] = y[Q_ven_sys] - Q_tv;
    rate[V_rv] = Q_tv - Q_pv;
    add_vessels(p_.systemic, y, {p_ar_sys, Q_ar_sys}, Ends<T>{Q_av, p_ra}, rate);
    add_vessels(p_.pulmonary, y, {p_ar_pul, Q_ar_pul}, Ends<T>{Q_pv, p_la}, rate);
    return rate;
  }

  [[nodiscard]] Signals signals(double t, const States<double>& y, double p) const {
    const double p_la = la_.pressure(t, y[V_la]);
    return {.volume = y[V_lv],
            .pressure = p,
            .filling_pressure = p_la,
            .aortic_pressure = y[p_ar_sys],
            .mitral_gradient = p_la - p,
            .aortic_gradient = p - y[p_ar_sys],
            .mitral_flow = valve_.flow(p_la - p),
            .aortic_flow = valve_.flow(p - y[p_ar_sys]),
            .others = {y[V_la], y[V_ra], y[V_rv], ra_.pressure(t, y[V_ra]),
                       rv_.pressure(t, y[V_rv]), y[p_ven_sys], y[p_ar_pul], y[p_ven_pul]}};
  }

  [[nodiscard]] static std::vector<Column> columns() {
    return {{"left_atrial_volume", "ml"},
            {"right_atrial_volume", "ml"},
            {"right_ventricular_volume", "ml"},
            {"right_atrial_pressure", "mmHg"},
            {"right_ventricular_pressure", "mmHg"},
            {"systemic_venous_pressure", "mmHg"},
            {"pulmonary_arterial_pressure", "mmHg"},
            {"pulmonary_venous_pressure", "mmHg"}};
  }

  /// All blood [mm^3].
  [[nodiscard]] double blood(const States<double>& y) const {
    return y[V_lv] + y[V_la] + y[V_ra] + y[V_rv] + p_.systemic.C_ar * y[p_ar_sys] +
           p_.systemic.C_ven * y[p_ven_sys] + p_.pulmonary.C_ar * y[p_ar_pul] +
           p_.pulmonary.C_ven * y[p_ven_pul];
  }

 private:
  /// Where arteries have their pressure and flow in y; those of the veins follow them.
  struct Place {
    int p, Q;
  };
  /// What flows into arteries, and the pressure that veins end at.
  template <class T>
  struct Ends {
    T inflow, outlet;
  };

  template <class T>
  static void add_vessels(const VesselParameters& v, const States<T>& y, const Place& at,
                          const Ends<T>& ends, States<T>& rate) {
    const auto [p, Q] = at;
    rate[p] = (ends.inflow - y[Q]) / v.C_ar;
    rate[p + 1] = (y[Q] - y[Q + 1]) / v.C_ven;
    rate[Q] = (y[p] - y[p + 1] - v.R_ar * y[Q]) / v.L_ar;
    rate[Q + 1] = (y[p + 1] - ends.outlet - v.R_ven * y[Q + 1]) / v.L_ven;
  }

  ClosedLoopParameters p_;
  Valve valve_;
  Elastance la_, ra_, rv_;
};

}  // namespace lv::circulation
