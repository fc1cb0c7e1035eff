#pragma once

#include "lv/image/volume.hpp"

#include <optional>
#include <vector>

namespace lv::image {

/// One frame of a label map on slices across the long axis of the ventricle, if its own slices lie
/// more than 15 degrees askew to it and its voxels are at most 3 mm long, as in maps drawn on a
/// volume along the patient's axes; nothing else. Only cavity (the first of its labels), muscle
/// (the first of its labels) and 0 are left.
///
/// The long axis runs from the tip, the middle of the hundredth part of the ventricle that lies
/// farthest from the base, to the middle of the base, which is where the cavity borders neither
/// itself nor muscle. Slices are twice the largest spacing apart and begin half of that below the
/// middle of the base, so that their slabs end there; pixels have the smallest spacing. The
/// indicator functions of cavity and muscle are interpolated linearly between the voxels, and the
/// larger of them and the rest is taken. A map without an opening of the cavity is left as it is.
[[nodiscard]] std::optional<Volume> on_short_axis(const Volume& volume,
                                                  const std::vector<int>& cavity,
                                                  const std::vector<int>& muscle, int frame);

}  // namespace lv::image
