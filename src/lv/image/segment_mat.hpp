#pragma once

#include "lv/image/foreign_contours.hpp"

namespace lv::image {

/// Whether a file is of MATLAB (version 5 or 7.3).
[[nodiscard]] bool holds_segment_mat(const std::filesystem::path& file);

/// Reads the contours of Segment (Medviso): variable setstruct, fields EndoX, EndoY, EpiX, EpiY,
/// RVEndoX, RVEndoY of points x times x slices, NaN where there are none. With the image's unit
/// vectors r along columns, IO(1:3), and c along rows, IO(4:6), of ImageOrientation,
///
///   place = ImagePosition + c ResolutionX (X - 1) + r ResolutionY (Y - 1)
///           - (r x c) (SliceThickness + SliceGap) (z - 1)   [mm]
///
/// Structures are called Endo, Epi and RVEndo, of several stacks with contours "stack 2: Endo".
/// Throws InputError for files that are damaged or not of Segment, and for stacks that were
/// rotated.
[[nodiscard]] ForeignContours read_segment_mat(const std::filesystem::path& file);

}  // namespace lv::image
