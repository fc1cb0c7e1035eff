#pragma once

#include "lv/base/tensor.hpp"
#include "lv/geometry/frame.hpp"
#include "lv/geometry/parameters.hpp"
#include "lv/geometry/star_surface.hpp"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace lv::geometry {

/// What kind of contour a point belongs to.
enum class Source { short_axis, long_axis, apex };

/// A contour point to be fitted.
struct Sample {
  Vec3 x;         ///< model frame [mm]
  double length;  ///< of the contour it stands for [mm]
  Source source;
  int slice = -1;  ///< of a short-axis point: index of the plane in which it may move
};

/// What the surfaces are fitted to: the points of each side (endo, epi) and, to let slices move,
/// their planes (any origin, z normal).
struct FitData {
  std::array<std::vector<Sample>, 2> samples;
  std::vector<Frame> planes;
};

struct FittedSurfaces {
  StarSurface endo, epi;
  std::vector<Vec3> shifts;  ///< of each slice, in its plane [mm]; empty if slices stay
};

/// The spheroid through the deepest point whose section r^2 = p h - q h^2, h the height above that
/// point, is nearest to the points in the sense of least squares, with its centre kept between 15
/// and 45 per cent of the depth below the base.
[[nodiscard]] Spheroid reference_spheroid(const std::vector<Sample>& samples);

/// Fits both surfaces, and with `data.planes` the positions of the slices, by minimising for each
/// surface
///
///   1/W sum_i w_i d_i^2 + l^4/A integral over the spheroid of |h grad grad s|^2 dA,  W = sum w_i,
///
/// with d_i the distance [mm] of point i from the surface, l the smoothing length, A the area and
/// h(mu) the distance of the spheroid's tangent planes from its centre, so that h (s - 1) is the
/// surface's distance from the spheroid. At the pole s has one value and one tangent plane.
///
/// The weight w_i is the area of the spheroid nearer to point i than to any other. So the sum is
/// the mean square distance over the surface, however densely a contour is drawn: a point of a
/// short-axis loop stands for the step along the loop times the slice spacing, a point of a
/// long-axis curve only for what the loops leave it. Then, and only then, a ripple of wave number k
/// loses the same part l^4 k^4 / (1 + l^4 k^4) everywhere.
///
/// Where short and long axes disagree (other breath-holds, papillary muscles drawn in or out), each
/// counts by its variance: a first fit gives the mean square distance of either source, and in a
/// second one the long axes' weights are multiplied by short over long, as Gauss and Markov would
/// for independent errors. One such step only: repeated, it tends to trust one source alone. Slices
/// that may move are fitted without it, for there the long axes are what they are moved to.
///
/// A slice's shift D_k [mm] is held by the prior 0.01 w_k/W D_k^2 where w_k is the weight of its
/// points.
///
/// Gauss-Newton: d_i = F(x_i)/|grad F(x_i)| is linearised in the coefficients and shifts together.
[[nodiscard]] FittedSurfaces fit_surfaces(const FitData& data,
                                          const SplineFitParameters& parameters);

}  // namespace lv::geometry
