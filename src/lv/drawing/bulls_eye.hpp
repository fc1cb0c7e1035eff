#pragma once

#include "lv/drawing/canvas.hpp"

#include <array>
#include <string>
#include <vector>

namespace lv::drawing {

/// Sectors per ring from the base (outermost) to the apex: the paper's seven slices and the
/// American Heart Association's 17 segments.
[[nodiscard]] std::vector<int> seven_slices();
[[nodiscard]] std::vector<int> aha_17();

/// Sectors that one artery feeds, and where its name stands beside the plot.
struct Territory {
  std::string name;
  std::vector<int> sectors;  ///< from 0
  double angle;              ///< anticlockwise from the right [rad]
};

/// Which artery usually feeds each of the 17 segments: left anterior descending (LAD), right (RCA)
/// and circumflex (LCX). Cerqueira et al., Circulation 105:539, 2002.
[[nodiscard]] std::vector<Territory> coronary_territories();

/// The wall seen from the apex, flattened. The first sector of every ring is centred on the top
/// (anterior); the others follow anticlockwise (septum on the left), as in the AHA's numbering.
struct BullsEye {
  std::vector<int> sectors = aha_17();
  std::vector<double> values{};  ///< ring after ring; NaN: missing
  ColourScale scale{};
  std::vector<Colour> colours{};  ///< instead of the scale's, if any are given
  int decimals = 1;               ///< of the values printed; negative: none is printed
  std::array<std::string, 4> walls{"anterior", "septal", "inferior", "lateral"};
  bool is_numbered = false;              ///< sectors bear their numbers, from 1, above their values
  std::vector<Territory> territories{};  ///< parted by dark lines; none, or all sectors in them
};

[[nodiscard]] bool has_missing(const BullsEye& plot);

void draw(Canvas& canvas, const Box& box, const BullsEye& plot);

}  // namespace lv::drawing
