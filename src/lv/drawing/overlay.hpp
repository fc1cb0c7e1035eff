#pragma once

#include "lv/drawing/colour_map.hpp"
#include "lv/image/picture.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace lv::drawing {

/// A line drawn over an image, image space [mm].
struct OverlayLine {
  std::vector<Vec3> points;
  Colour colour;
  bool closed = false;
  bool dashed = false;
};

/// A letter at that edge of an image to which a direction in image space points.
struct EdgeLetter {
  std::string text;
  Vec3 direction;
};

/// An image with lines over it.
struct Overlay {
  std::string title;
  const image::Picture* picture = nullptr;
  std::vector<OverlayLine> lines;
  std::vector<EdgeLetter> letters{};  ///< those that point out of the image's plane are not drawn
};

/// Writes images side by side as PNG, as the scanner shows them, each cut to the part around its
/// lines, with a bar of 20 mm, grey values from the darkest to all but the brightest 1%. Throws
/// RunError naming a file that cannot be written.
void write_overlays(const std::vector<Overlay>& overlays, const std::string& footnote,
                    const std::filesystem::path& file);

}  // namespace lv::drawing
