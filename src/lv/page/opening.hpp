#pragma once

#include "lv/drawing/colour_map.hpp"
#include "lv/drawing/orientation.hpp"
#include "lv/page/views.hpp"
#include "lv/page/wall_series.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lv::page {

/// The wall as the page opens with it: circumferential strain at end-systole, in one of its views,
/// with the border of its infarct (M = 0.5). The browser has it before it can draw by itself.
struct Opening {
  std::string png;        ///< transparent beside the wall; its middle half-way between bottom and
                          ///< top of the reach
  double width_mm = 0.0;  ///< of the picture
};

/// The quantity that the page opens with, by its name in regions.csv.
inline constexpr const char* opening_quantity = "circumferential_strain";

/// The scale of that quantity on the page: from the 1st to the 99th percentile over the wall at all
/// moments of the regions.csv of all cases, as far to both sides of the middle; nothing without
/// results.
[[nodiscard]] std::optional<drawing::ColourScale> opening_scale(
    const std::vector<std::filesystem::path>& works);

/// The frames of a case's wall in time.
struct Course {
  std::vector<double> times;          ///< of the frames [s]; none without a wall
  std::optional<double> end_systole;  ///< [s]
  bool has_beats = false;             ///< of a circulation
};

/// The frame of each case that the page opens with, as its time slider has it
/// (web/src/shared.ts): end-systole's, or the last where one case has not come to it; of two cases
/// of heartbeats the first one's end-systole, and as far in the second one's beat. Nothing for a
/// case without a wall.
[[nodiscard]] std::vector<std::optional<std::size_t>> opening_frames(
    const std::vector<Course>& cases);

/// `order` is that of the wall's elements. The view looks from the side.
[[nodiscard]] Opening opening(const WallSeries& wall, int order, std::size_t frame,
                              const NamedView& view, const drawing::Orientation& orientation,
                              const drawing::ColourScale& scale);

}  // namespace lv::page
