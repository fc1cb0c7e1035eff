#pragma once

#include "lv/material/niederer_hunter_smith.hpp"
#include "lv/material/tension.hpp"

#include <boost/math/interpolators/cardinal_quintic_b_spline.hpp>

namespace lv::material {

/// Steady isometric tension T(lambda) of muscle whose calcium is held: that of
/// NiedererHunterSmith::steady_state, tabulated once and interpolated with continuous derivatives
/// (quintic B-spline) to 1e-8 of its value. Outside [stretch_min, stretch_max], where the guards
/// limit the law, T is constant. Copies share the table.
class SteadyTension {
 public:
  /// Throws RunError for calcium [uM] at which the tension jumps with the stretch or is too steep
  /// to tabulate (0.36 to 0.485 uM with the law's defaults): tension slows the unbinding of
  /// calcium, and at one and the same stretch muscle can be at balance in a weak and in a strong
  /// state.
  SteadyTension(const NiedererHunterSmith& law, double Ca);

  /// T [kPa].
  [[nodiscard]] double tension(double stretch) const;

  /// dT/dlambda [kPa], exactly that of tension(). Zero where T is constant.
  [[nodiscard]] double derivative(double stretch) const;

  [[nodiscard]] Tension at(double stretch) const { return {tension(stretch), derivative(stretch)}; }

 private:
  boost::math::interpolators::cardinal_quintic_b_spline<double> table_;
  double stretch_min_, stretch_max_;
};

}  // namespace lv::material
