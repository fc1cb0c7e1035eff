#pragma once

#include "lv/page/wall_series.hpp"

#include <array>
#include <vector>

namespace lv::page {

/// A long-axis plane: through the z axis, along a horizontal direction at an angle from x to y.
struct LongAxis {
  double angle = 0.0;  ///< [rad]

  /// The first coordinate in the plane, and the one out of it.
  [[nodiscard]] double along(double x, double y) const;
  [[nodiscard]] double across(double x, double y) const;
};

/// The blood in a long-axis plane, a rectangle of cells, those along its direction s fastest.
struct FlowSeries {
  std::array<int, 2> cells{};                ///< along s and z
  std::array<double, 2> lower{};             ///< corner [mm]
  std::array<double, 2> spacing{};           ///< [mm]
  std::vector<double> times;                 ///< [s]
  std::vector<std::vector<float>> velocity;  ///< per cell along s, across the plane, along z [mm/s]
  std::vector<std::vector<float>> pressure;  ///< [kPa]
};

/// Reads the plane out of frames of the blood, within `lower` and `upper` (s and z, mm): rows are
/// those of the grid, cells as wide along s as along x, each the mean of the four grid cells of its
/// row around its middle, weighted bilinearly. Throws RunError naming a file that cannot be read.
[[nodiscard]] FlowSeries read_flow_series(const std::vector<TimedFrame>& frames,
                                          const LongAxis& plane, const std::array<double, 2>& lower,
                                          const std::array<double, 2>& upper);

}  // namespace lv::page
