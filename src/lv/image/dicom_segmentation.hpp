#pragma once

#include "lv/image/volume.hpp"

#include <filesystem>

namespace lv::image {

/// Whether a file is a DICOM segmentation (SEG).
[[nodiscard]] bool holds_dicom_segmentation(const std::filesystem::path& file);

/// Reads a DICOM segmentation (PS3.3 C.8.20.2) as a map of labels: segment n, in order of their
/// numbers, has the label n, and every set of segments that a pixel belongs to together a label of
/// its own behind them; the names are those of the segments. Fractional segments count from half of
/// their largest value. Frames without a segment may be absent; those with a temporal position are
/// of several times. Throws InputError where the file is damaged or packed, a frame does not say
/// which segment it shows and where, frames are not parallel or not on one regular stack, or one
/// place is shown twice.
[[nodiscard]] Volume read_dicom_segmentation(const std::filesystem::path& file);

}  // namespace lv::image
