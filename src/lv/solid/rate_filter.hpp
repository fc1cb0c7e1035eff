#pragma once

#include "lv/base/tensor.hpp"

#include <span>
#include <vector>

namespace lv::solid {

/// Smooths the stretch rate in space before it enters the fading memory (A.11), over a length that
/// shrinks with the time step, so that a step longer than the explicit limit stays stable.
///
/// Muscle whose tension rises by k = dT/dlambda under a sudden stretch, (1+a) sum A_i T_0 in
/// (A.10), carries waves along its fibres at c = sqrt(k/rho), some 150 m/s in systole, and an
/// explicit step can follow only waves with omega dt < 2. Shorter ones have nothing to do with the
/// beat (their periods are below a millisecond) but blow up. With hat functions of width H around
/// the points of a coarse lattice, the smoothed rate is
///
///   r_c = sum_a w_a hat_c(X_a) r_a / sum_a w_a hat_c(X_a),   r~_a = sum_c hat_c(X_a) r_c,   w_a = V_a k_a
///
/// which multiplies the stiffness of a wave number k by sinc^4(kH/2), so that omega never exceeds
/// 0.724 c/H. The weights keep the stiffness symmetric. H is proportional to c dt: the change is of
/// second order in dt like the rest of the scheme, and a steady state, where no stretch changes,
/// does not see it.
class RateFilter {
 public:
  /// Node positions in the undeformed wall and the volumes V_a around them.
  RateFilter(std::span<const Vec3> nodes, std::span<const double> volumes);

  /// Replaces the rates by r~. `stiffness` is k per node; `width` is H [mm]. Hats
  /// narrower than half the mean distance of nodes would each see one node at most: the rates stay
  /// as they are.
  void smooth(std::span<const double> stiffness, double width, std::span<double> rates);

  /// The width that keeps a step of dt [s] stable, for the largest fibre wave speed c [mm/s].
  [[nodiscard]] static double stable_width(double wave_speed, double dt);

 private:
  struct Lattice;

  std::vector<Vec3> nodes_;
  std::vector<double> volumes_;
  Vec3 lower_, upper_;
  double narrowest_;                            ///< width that has an effect [mm]
  std::vector<double> weighted_rate_, weight_;  ///< per lattice point
};

}  // namespace lv::solid
