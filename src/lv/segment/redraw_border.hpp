#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/segment/heart.hpp"
#include "lv/segment/polar_points.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace lv::segment {

/// What an observer asks for who wants one border of one frame drawn again.
struct Redrawing {
  geometry::Side side = geometry::Side::endo;
  std::size_t frame = 0;
  Centre centre;                   ///< that polar pictures are round; its radius is the blood's
  std::vector<PolarPoint> points;  ///< through which the border runs, one at least
  std::optional<Radii> endo, epi;  ///< the borders as they stand, round the centre
};

/// Draws a border again, by the paths of draw_borders through the given points, on the rays nearest
/// to them: for the endocardium the blood's edge and the endocardium are held there, and with them
/// the middle of the wall; for the epicardium, which lies outside the endocardium that stands, the
/// epicardium is. Grey levels are learnt from the slice alone. The border as it stands, bent
/// through the points, takes the part that neighbouring slices and frames have in draw_borders.
/// What is found is made smooth as there, which leaves the points, and is bent back through them.
[[nodiscard]] Radii redraw_border(const image::CineSlice& slice, const Redrawing& asked,
                                  double fall);

}  // namespace lv::segment
