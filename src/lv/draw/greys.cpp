#include "lv/draw/greys.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lv::draw {

Greys grey_range(std::span<const image::CineSlice> slices) {
  constexpr std::size_t step = 17;  // of the pixels that are looked at
  std::vector<float> some;
  for (const image::CineSlice& slice : slices)
    for (const image::Picture& frame : slice.frames)
      for (std::size_t i = 0; i < frame.values.size(); i += step)
        if (std::isfinite(frame.values[i]))
          some.push_back(frame.values[i]);
  if (some.empty())
    return {0.0F, 1.0F};
  std::sort(some.begin(), some.end());
  const std::size_t out = some.size() / 1000;
  const float low = some[out];
  const float high = some[some.size() - 1 - out];
  return {low, high > low ? high : low + 1.0F};
}

std::string grey_bytes(const image::CineSlice& slice, const Greys& greys) {
  const auto [low, high] = greys;
  std::string bytes;
  for (const image::Picture& frame : slice.frames)
    for (const float v : frame.values) {
      const float part = std::isfinite(v) ? (v - low) / (high - low) : 0.0F;
      bytes.push_back(
          static_cast<char>(static_cast<unsigned char>(std::clamp(255.0F * part, 0.0F, 255.0F))));
    }
  return bytes;
}

}  // namespace lv::draw
