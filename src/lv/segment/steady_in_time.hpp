#pragma once

#include "lv/segment/polar.hpp"

#include <vector>

namespace lv::segment {

/// What a radius is in time when single frames are left out that stand off: the median of the
/// frame's own radius r, counted twice, of the straight lines through the two frames before and the
/// two after it, and of the mean of its neighbours. Where the radius turns round, at end-diastole
/// and end-systole, the lines lie beyond r and the mean within, and r stays, as long as frames
/// follow each other fast enough; a median of neighbours alone would take a part of the stroke
/// away. Frames are those of a cycle.
[[nodiscard]] std::vector<double> steady(const std::vector<double>& radius);

/// How far the motion itself stands off in each frame of a slice: steady(R) - R of the mean radius
/// R that this slice and those beside it share (their median) [mm]. It is 0 where frames follow
/// each other fast enough for straight lines to meet the motion, and where one slice alone stands
/// off. `radii`: of every slice, per frame, at least three slices.
[[nodiscard]] std::vector<double> shared_motion(const std::vector<std::vector<double>>& radii,
                                                std::size_t slice);

/// `steady` along every ray of the lines of a slice, less what its motion explains: a ray may stand
/// off, to the side to which `motion` (see shared_motion) does, by twice as much, for if half of
/// the wall stands still, as a scar may, the other half moves twice as far as the mean.
[[nodiscard]] std::vector<Radii> steady_in_time(const std::vector<Radii>& lines,
                                                const std::vector<double>& motion);

}  // namespace lv::segment
