#pragma once

#include "lv/implicit/newton.hpp"

namespace lv::implicit {

/// Brings a state to the equilibrium to which contracting muscle comes of itself where there is
/// none near by: where the stiffness is singular, at a limit point or on the switches of the law,
/// Newton's method finds no way on, however short the step. By the proximal point method (R. T.
/// Rockafellar, SIAM J. Control Optim. 14:877, 1976),
///
///   R(x_{k+1}) + mu_k M (x_{k+1} - x_k) = 0,   M the mass [kg],
///
/// which descends without inertia, in ever longer strides as mu [1/s^2] falls, and at last by R = 0
/// itself. False, with the state as it was, where that does not come to rest, and where the cavity
/// changes by more than a fifth on the way (the wall is blown up or closes). The equations' model
/// is as before. Collective.
[[nodiscard]] bool give_way(Equations& equations, Newton& newton, State& state,
                            const Equilibrium& equilibrium);

}  // namespace lv::implicit
