#pragma once

#include "lv/segment/polar.hpp"

#include <vector>

/// How unequally surface coils receive across the heart.
///
/// Their sensitivity s falls with the distance from them and multiplies all grey values. Blood is
/// equally bright by itself, so that in the cavity the grey value v follows s; over a heart the
/// logarithm is taken for linear, one gradient g for a study:
///
///   ln v = ln v_0 + g . x,     x from the centre along the picture's columns and rows [mm].
namespace lv::segment {

using CoilGradient = Eigen::Vector2d;  ///< [1/mm]

/// What one slice shows of its blood: polar pictures round the centre and how far out they are
/// within the cavity [mm].
struct BloodPool {
  const std::vector<Polar>& frames;
  double radius = 0.0;
};

/// Of each slice the gradient of least squares over its frames, each with a v_0 of its own, since
/// inflow changes it; what is darker than four fifths of the fit, papillary muscle, does not count.
/// Of all slices the median of either component: trabeculae darken one side at the tip. Steeper
/// than a factor of four over 100 mm it is not taken for; without blood it is 0.
[[nodiscard]] CoilGradient coil_gradient(const std::vector<BloodPool>& pools,
                                         const PolarGrid& grid);

/// exp(g . x) at all places of a polar picture: grey values divided by it are those of coils that
/// receive equally.
[[nodiscard]] Polar sensitivity(const CoilGradient& gradient, const PolarGrid& grid);

}  // namespace lv::segment
