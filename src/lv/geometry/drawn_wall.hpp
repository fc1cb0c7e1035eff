#pragma once

#include "lv/geometry/spline_wall.hpp"

#include <string>
#include <vector>

namespace lv::geometry {

/// A wall, where its base plane lies, and what was tried or could be.
struct DrawnWall {
  SplineWall wall;
  BaseAt base_at;
  std::vector<std::string> notes;
};

/// fit_spline_wall for contours as they are found, which says what else would help:
///
/// - A base plane in the mitral annulus that gives no wall (it lies far above the most basal slice)
///   is laid at the end of that slice's slab, with a note, if `base_may_move`; else the error names
///   it.
/// - Slices that lie as the scanner put them and whose contours are farther than 3 mm from the wall
///   are fitted again with align_slices. If that halves the distances (root mean square), or if
///   there is a wall only then, a note or the error says so, with the numbers.
///
/// @throws InputError as fit_spline_wall does
[[nodiscard]] DrawnWall fit_drawn_wall(const Contours& contours,
                                       const SplineFitParameters& parameters, bool base_may_move);

}  // namespace lv::geometry
