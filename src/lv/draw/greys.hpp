#pragma once

#include "lv/image/picture.hpp"

#include <span>
#include <string>

namespace lv::draw {

/// The grey values that are shown black and white.
struct Greys {
  float low = 0.0F, high = 1.0F;
};

/// Those of the darkest and brightest thousandth of some slices.
[[nodiscard]] Greys grey_range(std::span<const image::CineSlice> slices);

/// The pictures of a slice, a byte per pixel, frame by frame, row by row: 0 is black, 255 white.
[[nodiscard]] std::string grey_bytes(const image::CineSlice& slice, const Greys& greys);

}  // namespace lv::draw
