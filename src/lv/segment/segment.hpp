#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/image/label_contours.hpp"
#include "lv/segment/borders.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lv::segment {

/// How a cine is segmented.
struct SegmentParameters {
  /// A point in the left ventricle's blood, image space [mm]; none: it is found.
  std::optional<std::array<double, 3>> centre;
  double fall = 0.0;  ///< see draw_borders; 0: from the study's own edges
};

/// The ventricle in a short-axis cine. Slices and frames count from 0, in the cine's order.
struct Segmentation {
  std::vector<SliceBorders> borders;     ///< of every slice
  std::vector<std::vector<char>> shows;  ///< slice, frame: whether it shows the ventricle
  double fall = 0.0;                     ///< see draw_borders
  double spacing = 0.0;                  ///< between slices [mm]
  std::vector<double> volumes;           ///< of the cavity per frame, areas x spacing [mm^3]
  image::Phases phases;
  std::vector<std::string> doubts;    ///< what an observer should look at, in sentences
  std::vector<std::string> warnings;  ///< what makes volumes, masses or moments wrong, likewise
};

/// A contour whose border agrees with the image along a smaller part (FrameBorders) is doubtful.
inline constexpr double doubtful = 0.6;

/// Throws InputError, with `where` naming the images, unless there are three slices or more with
/// equally many images, at least five.
void require_cine(const image::Cine& cine, const std::string& where);

/// Draws both borders on every slice and frame and decides which slices show the ventricle.
///
/// - Slices belong to it, from the one that looks most like it outwards, while muscle surrounds
///   half of the blood or more in half of the frames, and blood and muscle differ by half of what
///   they do in most slices.
/// - From the base (the end with larger areas) slices are dropped whose area, as a part of its
///   mean, changes by less than half of what the others' does, or against it: an atrium fills while
///   the ventricle empties. Slices beyond the base that muscle surrounds over three quarters while
///   the others hold most (a quarter of the frames) are added for the frames in which those hold
///   more than the middle of what they do: the base moves through them. In a frame the most basal
///   ones are left out where muscle surrounds less than half (median over a tenth of the cycle
///   either way), the most apical ones where the cavity's mean radius is below 3 mm.
/// - Phases are proposed from the volume of the slices that show the ventricle in all frames.
///
/// Throws InputError, with `where` naming the images, if slices have different numbers of images or
/// fewer than five, pixels do not lie above each other within a slice, a slice shows nothing,
/// fewer than three slices show a ring of muscle round blood, or end-systole holds more than
/// end-diastole.
[[nodiscard]] Segmentation segment(const image::Cine& cine, const SegmentParameters& parameters,
                                   const std::string& where);

/// The muscle between the borders of a frame, areas x spacing [mm^3].
[[nodiscard]] double muscle_volume(const Segmentation& found, std::size_t frame);

/// The part of a frame's cavity volume that lies in slices whose endocardium is doubtful, 0 to 1.
[[nodiscard]] double doubtful_part(const Segmentation& found, std::size_t frame);

/// The loops of a frame, slices counted from 1 in the cine's order.
[[nodiscard]] geometry::Contours contours_at(const image::Cine& cine, const Segmentation& found,
                                             std::size_t frame);

}  // namespace lv::segment
