#pragma once

#include "lv/segment/polar.hpp"

#include <optional>
#include <vector>

namespace lv::segment {

/// Where a slice shows the left ventricle.
struct Centre {
  Pixel at = Pixel::Zero();
  double likeness = 0.0;  ///< to a ring of muscle round blood, 0 to 1
  double radius = 0.0;    ///< of the blood [mm]
};

struct Heart {
  std::vector<Centre> centres;  ///< one per slice
  std::size_t seed = 0;         ///< the slice that the others were found from
};

/// How much a place looks like the middle of the left ventricle: the product of
///
///   the steepness of the closed path round it along which the image falls most,
///   the part of the ring 3 to 7 mm outside that is equally bright, and not as dark as lung: muscle,
///   its roundness, 1 - 2 deviation/mean of the radii,
///   the part inside that is as bright as the middle: blood,
///
/// each 0 to 1, their product's mean over some frames. The right ventricle, as bright and moving as
/// much, is neither round nor in a ring.
[[nodiscard]] Centre judge(const std::vector<const image::Picture*>& frames, const Pixel& place);

/// Finds the left ventricle: the likeliest place of all slices among those that move as much as
/// three tenths of the most moving ones, or near `given` [image space, mm]; then from slice to
/// slice, each near the centroid of the one before. Slices need two frames at least.
[[nodiscard]] Heart find_heart(const image::Cine& cine, const std::optional<Vec3>& given);

}  // namespace lv::segment
