#pragma once

#include "lv/segment/long_axis_marks.hpp"
#include "lv/segment/segment.hpp"

#include <string>
#include <vector>

namespace lv::segment {

/// The ventricle's ends as long-axis images show them.
struct LongAxisEnds {
  std::vector<std::vector<LongAxisMarks>> views;  ///< by view and frame of the short-axis cine
  std::vector<std::string> doubts;                ///< what an observer should look at, in sentences
};

/// Finds the ends on every long-axis image at end-diastole (see find_marks), and follows them
/// through the cycle by the deformable registration of strain::Tracker. A view may have another
/// number of images than the slices: both cover one cycle evenly.
///
/// Doubted are ends that are not found or of a confidence below `doubtful`, tips that views show
/// more than 5 mm apart, and slices taken for the ventricle that lie above the annulus, or left out
/// that lie between tip and annulus. A point of the annulus that moves away from the apex by more
/// than 1 mm until end-systole is none: its confidence becomes 0.
[[nodiscard]] LongAxisEnds find_ends(const image::Cine& cine, const Segmentation& found,
                                     const std::vector<image::CineSlice>& views);

/// A point of the annulus: view and side, as LongAxisMarks has it.
struct AnnulusPoint {
  std::size_t view = 0, side = 0;
  Vec3 at = Vec3::Zero();  ///< image space [mm]
};

/// The points of the annulus in a frame that are not doubtful; none unless one view shows both of
/// its own.
[[nodiscard]] std::vector<AnnulusPoint> annulus_at(const LongAxisEnds& ends, std::size_t frame);

/// The tip of the cavity.
struct Tip {
  std::size_t view = 0;    ///< that shows it best
  Vec3 at = Vec3::Zero();  ///< the mean of all views in which it is not doubtful [mm]
};

[[nodiscard]] std::optional<Tip> apex_at(const LongAxisEnds& ends, std::size_t frame);

/// The number, from 0, of the picture of a view that belongs to one of so many frames of the
/// slices.
[[nodiscard]] std::size_t picture_of(const image::CineSlice& view, std::size_t frame,
                                     std::size_t frames);

}  // namespace lv::segment
