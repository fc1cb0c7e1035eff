#pragma once

#include "lv/image/picture.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace lv::image {

/// What the base took from slices of a label map, and what was made of it.
struct CutBase {
  std::vector<std::size_t> slices;  ///< that were changed, counted from 0
  std::vector<std::string> notes;   ///< by slice
  double left_out = 0.0;            ///< cavity of the slices that were left out [mm^3]
  double added = 0.0;               ///< cavity that was added to others [mm^3]
};

/// Makes slices whole that a base tilted to them cuts, as the base plane of the wall lies across
/// its long axis: where the base has taken up to half of the cavity, it and its muscle are added as
/// they are on the slices below; where it has taken more, the slice is left out. A cut slice is one
/// of the most basal (the end with the larger cavities), shows muscle, has its cavity within the
/// ventricle of the slice below, borders neither cavity nor muscle on 15% of its edge or more, and
/// lacks a tenth or more of the cavity below, where it shows neither. Three whole slices must
/// stay; nothing is done where a whole slice lies above a cut one.
///
/// `pictures` are the labels by slice along the slice axis, `slab` what a slice is thick [mm].
[[nodiscard]] CutBase mend_cut_base(std::vector<Picture>& pictures, const std::vector<int>& cavity,
                                    const std::vector<int>& muscle, double slab);

}  // namespace lv::image
