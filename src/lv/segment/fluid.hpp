#pragma once

#include "lv/segment/polar.hpp"

#include <vector>

/// Fluid in the pericardium, where it is only a little brighter than muscle: a border that runs
/// round it encloses two layers of grey values, each even in itself.
namespace lv::segment {

/// The least step of brightness that tells fluid from muscle, of the way from muscle to blood.
inline constexpr double least_fluid = 0.07;

/// How much brighter than the muscle the layer next to the epicardium is, along each ray, as a part
/// of the way from muscle to blood; 0 where there is no such layer.
///
/// Along a ray of a frame the wall, but for 1.5 mm at either border, is split where the means of
/// both sides tell most of its variance. There is fluid where, in the median of the frames and of
/// the rays within 10 degrees, both sides are 2.2 mm deep or more, the step tells most of the
/// variance, and the outer side is even: blurred edges are not.
///
/// `brightness`: 0 muscle, 1 blood, per frame, as `endo` and `epi`.
[[nodiscard]] Radii fluid_within(const std::vector<Polar>& brightness,
                                 const std::vector<Radii>& endo, const std::vector<Radii>& epi,
                                 const PolarGrid& grid);

}  // namespace lv::segment
