#pragma once

#include "lv/image/foreign_contours.hpp"

namespace lv::image {

/// Whether a file is a DICOM structure set (RTSTRUCT).
[[nodiscard]] bool holds_rt_structures(const std::filesystem::path& file);

/// Reads the closed contours (CLOSED_PLANAR) of a DICOM structure set (PS3.3 C.8.8.5 and C.8.8.6),
/// in the patient's mm, by the names of their regions of interest. Which of them are the borders of
/// the left ventricle, no standard says. Lines and points are counted in a note. Throws InputError
/// where the file is damaged.
[[nodiscard]] ForeignContours read_rt_structures(const std::filesystem::path& file);

}  // namespace lv::image
