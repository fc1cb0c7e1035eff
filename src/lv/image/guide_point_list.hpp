#pragma once

#include "lv/base/tensor.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lv::image {

/// A point of a list of guide points (see read_guide_points).
struct GuidePoint {
  Vec3 x;            ///< [mm]
  std::string type;  ///< "SAX_LV_ENDOCARDIAL" and so on
  int slice = 0, frame = 0, line = 0;
  double weight = 1.0;
};

/// All points of a list, each line once. A point that is there before (same type, slice and time,
/// less than a micrometre away) is dropped, with a note, and so is one of weight 0 or less. Throws
/// InputError with file and line.
[[nodiscard]] std::vector<GuidePoint> read_guide_point_list(const std::filesystem::path& file,
                                                            std::vector<std::string>& notes);

/// The times of which one must be chosen for points_of_time; a single one if nothing is to be
/// chosen.
[[nodiscard]] std::vector<int> times_to_choose(const std::vector<GuidePoint>& points);

/// The points of one time, which is that of the short-axis loops; `frame` must be given if loops of
/// several times share a slice. An image that bears a time which no loop bears has another count of
/// its own: its points belong to the others, with a note. So do all, if no image bears two times.
[[nodiscard]] std::vector<GuidePoint> points_of_time(std::vector<GuidePoint> points,
                                                     std::optional<int> frame,
                                                     const std::string& file,
                                                     std::vector<std::string>& notes);

}  // namespace lv::image
