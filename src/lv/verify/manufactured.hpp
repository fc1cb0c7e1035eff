#pragma once

#include "lv/fluid/stokes.hpp"

namespace lv::verify {

/// A smooth unsteady flow in the box [0, L] that satisfies the sides' conditions (p = 0, u_t = 0,
/// d(u_n)/dn = 0) and the continuity equation:
///
///   u = g(t) curl (psi_x e_x + psi_z e_z),   psi_z = U L_z/pi  e(x) e(y) s(z),   psi_x = U L_x/pi s(x) e(y) e(z)
///   p = p_0 g(t) s(x) s(y) s(z),             g(t) = 1 + sin(omega t)/2
///
/// with e(x) = exp(cos(pi x/L_x)), even about the sides, and s(x) = sin(pi x/L_x), odd. It has all
/// Fourier modes, so no grid resolves it exactly.
class ManufacturedFlow {
 public:
  Vec3 box{30.0, 36.0, 42.0};  ///< L [mm]
  double U = 60.0;             ///< [mm/s]
  double p_0 = 0.05;           ///< [kPa]
  double omega = 25.0;         ///< [1/s]
  fluid::Blood blood{1e-6, 5e-4};
  double drag = 5.0;  ///< [1/s]

  [[nodiscard]] Vec3 velocity(const Vec3& x, double t) const;

  /// The force density that sustains the flow,
  ///   f = rho (du/dt + c u) + grad p - mu lap u  [+ rho u.grad u]
  [[nodiscard]] Vec3 force(const Vec3& x, double t, bool convection) const;

 private:
  struct Derivatives;
  [[nodiscard]] double g(double t) const;
  [[nodiscard]] double g_rate(double t) const;
  [[nodiscard]] Derivatives shape(const Vec3& x) const;
};

}  // namespace lv::verify
