#pragma once

#include "lv/implicit/newton.hpp"

#include <functional>
#include <vector>

namespace lv::implicit {

/// The straight way from some loads to others, of which a share s is applied.
struct WayOfLoads {
  Loads from, to;

  /// Beyond the ends too.
  [[nodiscard]] Loads at(double s) const {
    return {(1.0 - s) * from.pressure + s * to.pressure,
            (1.0 - s) * from.activation + s * to.activation,
            (1.0 - s) * from.calcium + s * to.calcium};
  }
};

/// Where the share of the loads turns on the path of equilibria: a limit point of the wall, beyond
/// which no equilibrium is near.
struct Turn {
  double share = 0.0;         ///< s there [-]
  bool is_highest = true;     ///< s falls beyond it; else it rises again
  Vec3 place = Vec3::Zero();  ///< undeformed place of the node that moves most there [mm]
  double width = 0.0;  ///< share of the nodes that move, 1/(n sum m_i^2) with the nodes' shares m_i
                       ///< of the squared motion [-]
};

struct PathParameters {
  LinearParameters linear = {};
  double tolerance = 1e-6;  ///< rms of the last correction of the positions [mm]
  double first = 0.05;      ///< length of the first step [mm]
  double longest = 1.0;     ///< [mm]
  double shortest = 1e-5;   ///< before it gives up [mm]
  int most_steps = 300;     ///< before it gives up
};

/// How a path went.
struct [[nodiscard]] Path {
  bool arrived = false;  ///< at s = 1
  std::string why;       ///< it did not
  double share = 0.0;    ///< where it ended [-]
  std::vector<Turn> turns;
};

/// One equilibrium of a path.
struct PathStep {
  double share = 0.0;   ///< s [-]
  double slope = 0.0;   ///< ds by the length of the path [1/mm]; changes its sign at a turn
  double length = 0.0;  ///< of the step [mm]
  double volume = 0.0;  ///< of the cavity [mm^3]
  int corrections = 0;
};

/// Follows the equilibria R(u, s) = 0 under a share s of a way of loads by the length of their path
/// in place of s (pseudo-arclength: H. B. Keller, in Applications of Bifurcation Theory, 1977;
/// bordering: M. A. Crisfield, Comput. Struct. 13:55, 1981), so that it passes limit points, where
/// s turns and the tangent K = dR/du is singular. From an equilibrium (u_0, s_0) with the path's
/// direction t = (t_u, t_s),
///
///   R(u, s) = 0,   t_u.(u - u_0) + w^2 t_s (s - s_0) = L
///
/// by Newton's method, for which one factorisation of K serves two right-hand sides: with a = -K^-1
/// R, b = -K^-1 dR/ds and the second equation's residual n, ds = -(n + t_u.a)/(w^2 t_s + t_u.b) and
/// du = a + b ds. u.v is the mean over the nodes of the products of their displacements and w = 1
/// mm, so that L is rms displacement [mm] where the loads change little. R is linear in s.
///
/// `state` is an equilibrium at `share` of the way, and is left at the last one. `observe` may be
/// empty. Collective.
Path follow_path(const Equations& equations, State& state, double share, const WayOfLoads& way,
                 const PathParameters& parameters = {},
                 const std::function<void(const PathStep&, const State&)>& observe = {});

}  // namespace lv::implicit
