#pragma once

#include <filesystem>
#include <string>

namespace lv::page {

/// The cine's images in the results of a work folder with the outlines of the model and the
/// contours drawn on them, as JSON for the page: per image state, slice, phase, columns, rows,
/// spacing_i_mm, spacing_j_mm, along_row, along_column (in image space), its pixels as base64 of a
/// PNG, and lines with source (model or contours), contour (endo or epi) and points: x, y, x, y ...
/// in pixels from the upper left corner of the image. Empty if the results hold no images.
[[nodiscard]] std::string pictures_json(const std::filesystem::path& work);

}  // namespace lv::page
