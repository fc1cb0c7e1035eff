#pragma once

#include "lv/implicit/damped_newton.hpp"
#include "lv/implicit/equations.hpp"

#include <functional>

namespace lv::implicit {

/// A cavity whose volume is given as a function of its pressure, and how it changes with it.
struct GivenVolume {
  double volume = 0.0;        ///< V_0D [mm^3]
  double per_pressure = 0.0;  ///< dV_0D/dp [mm^3/kPa]
};
using VolumeOfPressure = std::function<GivenVolume(double pressure)>;

/// What Newton's method solves: the wall's equilibrium with this active tension, under a pressure
/// in the cavity or around a volume of it.
struct Equilibrium {
  TensionAt tension;
  double pressure = 0.0;           ///< [kPa], where no volume is given
  VolumeOfPressure volume = {};    ///< may be empty
  const Motion* motion = nullptr;  ///< none: the wall is at rest
  solid::BasePlace base = {};      ///< where the base is held
};

/// Equilibria by Newton's method (DampedNewton), with a tangent that is kept from one to the next.
///
/// Where the cavity's volume is given, its pressure p is an unknown, the multiplier of V(u) =
/// V_0D(p). With the residuals r_u and r_V = V - V_0D, the force g of a unit pressure, h = dV/du
/// and c = dV_0D/dp,
///
///   a = -K^-1 r_u,  b = K^-1 g,  dp = -(r_V + h.a)/(h.b - c),  du = a + b dp
///
/// g and h differ where the base leaves its plane (EndocardialSurface). b is kept with the tangent.
class Newton {
 public:
  /// The equations must outlive this object.
  Newton(const Equations& equations, const NewtonParameters& parameters);

  /// Brings `state` to equilibrium, or leaves it as it was. Collective.
  NewtonReport solve(State& state, const Equilibrium& equilibrium);

  /// The same with the steady tension of an activation, under a pressure in the cavity.
  NewtonReport solve(State& state, const Loads& loads) {
    return solve(state, {equations_.steady(loads.activation), loads.pressure});
  }

  /// The muscle has changed: the tangent is of no use any more.
  void forget_tangent() { has_tangent_ = false; }

  /// The same, and what the linear solver chose for earlier tangents.
  void begin_anew() {
    has_tangent_ = false;
    tangent_.forget_factors();
  }

 private:
  class Problem;

  const Equations& equations_;
  NewtonParameters parameters_;
  SparseMatrix tangent_;
  std::vector<double> gradient_;  ///< h, where a volume is given
  std::vector<double> response_;  ///< b
  bool has_tangent_ = false;
};

}  // namespace lv::implicit
