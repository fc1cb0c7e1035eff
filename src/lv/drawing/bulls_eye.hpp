#pragma once

#include "lv/drawing/canvas.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lv::drawing {

/// Sectors per ring from the base (outermost) to the apex: the paper's seven slices and the
/// American Heart Association's 17 segments.
[[nodiscard]] std::vector<int> seven_slices();
[[nodiscard]] std::vector<int> aha_17();

/// The wall seen from the apex, flattened. The first sector of every ring is centred on the top
/// (anterior); the others follow anticlockwise (septum on the left), as in the AHA's numbering.
struct BullsEye {
  std::vector<int> sectors = aha_17();
  std::vector<double> values{};  ///< ring after ring; NaN: missing
  ColourScale scale{};
  std::vector<Colour> colours{};  ///< instead of the scale's, if any are given
  int decimals = 1;               ///< of the values printed; negative: none is printed
  std::array<std::string, 4> walls{"anterior", "septal", "inferior", "lateral"};
};

[[nodiscard]] bool has_missing(const BullsEye& plot);

void draw(Canvas& canvas, const Box& box, const BullsEye& plot);

}  // namespace lv::drawing
