#pragma once

#include "lv/page/wall_series.hpp"

#include <array>
#include <vector>

namespace lv::page {

/// The blood in the long-axis plane y = 0 (through the middle of the septum where the model's x
/// axis points to it), a rectangle of cells, x fastest.
struct FlowSeries {
  std::array<int, 2> cells{};                ///< along x and z
  std::array<double, 2> lower{};             ///< corner [mm]
  std::array<double, 2> spacing{};           ///< [mm]
  std::vector<double> times;                 ///< [s]
  std::vector<std::vector<float>> velocity;  ///< three numbers per cell [mm/s]
  std::vector<std::vector<float>> pressure;  ///< [kPa]
};

/// Reads the plane out of frames of the blood, within `lower` and `upper` (x and z, mm); the mean
/// of the two layers of cells at y = 0. Throws RunError naming a file that cannot be read.
[[nodiscard]] FlowSeries read_flow_series(const std::vector<TimedFrame>& frames,
                                          const std::array<double, 2>& lower,
                                          const std::array<double, 2>& upper);

}  // namespace lv::page
