#pragma once

#include "lv/geometry/spline_wall.hpp"

#include <string>
#include <vector>

namespace lv::geometry {

/// A wall, where its base plane lies, in words, and what was tried or could be.
struct DrawnWall {
  SplineWall wall;
  std::string base;
  std::vector<std::string> notes;
  std::vector<Assumption> warnings;  ///< slices that had to be moved
};

/// What of the parameters a fit may choose differently where there is no wall with them: a case
/// that sets them means them.
struct MayMove {
  bool base = false;    ///< the base plane
  bool slices = false;  ///< the slices, in their planes
};

/// fit_spline_wall for contours as they are found, which says what else would help:
///
/// - A base plane in the mitral annulus is laid as high as the curves on two or more long-axis
///   images show muscle all round, if it may move: at the lowest of their ends, for the annulus
///   is tilted, and there is no muscle between its lowest and its mean point. This plane moves with
///   the heart and does not jump where a slice comes or goes. Curves that end more than half a slice
///   spacing below the most basal slice are drawn short and do not tell.
/// - If there is no wall with that plane, or with that in the annulus where there are no such
///   curves, it is laid at the end of the most basal slice's slab, with a note, if it may move;
///   else the error names it.
/// - If there is no wall with the slices as the scanner put them, but one with align_slices, that
///   one is taken, with a warning, if they may move; else the error names it.
/// - Slices that lie as the scanner put them and whose contours are farther than 3 mm from the wall
///   are fitted again with align_slices. If that halves the distances (root mean square), a note
///   says so, with the numbers.
///
/// @throws InputError as fit_spline_wall does
[[nodiscard]] DrawnWall fit_drawn_wall(const Contours& contours,
                                       const SplineFitParameters& parameters,
                                       const MayMove& may_move);

}  // namespace lv::geometry
