#pragma once

#include "lv/segment/polar.hpp"

namespace lv::segment {

/// What a border is fitted to, ray by ray.
struct BorderFit {
  Radii seen;         ///< where the border was found [mm]
  Radii weight;       ///< how far that counts
  Radii expected;     ///< where it should be by what is known of its neighbours [mm]
  Radii trust;        ///< how far that counts
  int harmonics = 3;  ///< of the angle
  double within =
      1.0;  ///< part of its weight that a ray keeps where what was seen lies inside the fit
  double stiffness = 0.0;  ///< of the line against bending out of a circle
};

/// The sum of harmonics r(theta) that makes
///
///   sum_i w_i (r(theta_i) - seen_i)^2 + trust_i (r(theta_i) - expected_i)^2
///     + stiffness sum_n (n^2 - 1)^2 (a_n^2 + b_n^2)
///
/// least, a_n and b_n the harmonics' amplitudes, w_i = weight_i, times `within` where
/// seen_i < r(theta_i): papillary muscles, which push the border inwards, then count little, and
/// the line runs round on where they hide it.
[[nodiscard]] Radii fit_border(const BorderFit& fit);

/// The sum of as many harmonics nearest to a line.
[[nodiscard]] Radii harmonics_of(const Radii& radii, int harmonics);

/// The radius, `angle` from the first, of the straight line between two points `whole` apart in
/// angle, less than half a turn [rad].
[[nodiscard]] double chord(double r1, double r2, double angle, double whole);

/// A line drawn in to the straight line from one end of the muscle to the other where no muscle is
/// seen, over less than half a turn: so observers close the outflow tract. `seen` is where the
/// border was found, `sees` 1 on rays on which muscle is seen behind it and 0 elsewhere.
[[nodiscard]] Radii closed_straight(const Radii& line, const Radii& seen, const Radii& sees);

/// The convex hull of a line round the centre, on the same rays.
[[nodiscard]] Radii convex(const Radii& radii);

}  // namespace lv::segment
