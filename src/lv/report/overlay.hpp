#pragma once

#include "lv/image/picture.hpp"
#include "lv/report/colour_map.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace lv::report {

/// A line drawn over an image, image space [mm].
struct OverlayLine {
  std::vector<Vec3> points;
  Colour colour;
  bool closed = false;
  bool dashed = false;
};

/// An image with lines over it.
struct Overlay {
  std::string title;
  const image::Picture* picture = nullptr;
  std::vector<OverlayLine> lines;
};

/// Writes images side by side as PNG, each cut to the part around its lines, grey values from the
/// darkest to all but the brightest 1%. Throws RunError naming a file that cannot be written.
void write_overlays(const std::vector<Overlay>& overlays, const std::string& footnote,
                    const std::filesystem::path& file);

}  // namespace lv::report
