#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/image/picture.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace lv::segment {

/// One border of one frame, and where an observer wants it. Points are in image space [mm].
struct BorderWish {
  geometry::Side side = geometry::Side::endo;
  std::size_t frame = 0;
  std::vector<Vec3> points;     ///< that it must run through, one at least
  std::vector<Vec3> endo, epi;  ///< the closed lines as they stand; empty where there is none
};

/// The border drawn again (see redraw_border) round the middle of the endocardium that stands, else
/// of the epicardium, else of the points: a closed line of 72 points, of which those nearest to the
/// observer's are the observer's own. Throws InputError, with `where` naming who asks, if there are
/// fewer than three points where no border stands, or one lies farther from the middle than the
/// polar picture reaches (59 mm).
[[nodiscard]] std::vector<Vec3> redraw(const image::CineSlice& slice, const BorderWish& wish,
                                       double fall, const std::string& where);

}  // namespace lv::segment
