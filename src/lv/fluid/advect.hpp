#pragma once

#include "lv/fluid/field.hpp"

namespace lv::fluid {

/// Weights that extrapolate the convection to the middle of the next step: now * N(u) + before *
/// N(u_previous). Equal steps: 3/2 and -1/2 (Adams-Bashforth).
struct Extrapolation {
  double now = 1.5;
  double before = -0.5;
};

/// The convection term of (2.1) in conservative form, N = div (u u), on the staggered grid:
/// momentum fluxes through the sides of each velocity's control volume, with the advecting velocity
/// averaged to the side and the advected one interpolated there with a third-order upwind-biased
/// formula (kappa = 1/3). Central fluxes are unstable in the jets at the base; this one damps the
/// shortest waves in proportion to the local velocity.
///
/// Sets `force` to -rho (now N(u) + before N_previous) and leaves N(u) in `previous`. Needs the
/// ghosts of `velocity`.
void convection_force(const FaceField& velocity, const Grid& grid, double density,
                      const Extrapolation& weights, FaceField& previous, FaceField& force);

}  // namespace lv::fluid
