#pragma once

#include "lv/image/foreign_contours.hpp"

namespace lv::image {

/// Whether a file is an XML workspace of cvi42 (.cvi42wsx), by itself or in a zip archive.
[[nodiscard]] bool holds_cvi42(const std::filesystem::path& file);

/// Reads the contours of a workspace of cvi42 (Circle Cardiovascular Imaging), in pixels of the
/// images they name:
///
///   pixel = Points / SubpixelResolution
///
/// Structures have cvi42's names; the borders on short axes are saendocardialContour and
/// saepicardialContour. Papillary muscles, reference regions and no-reflow are not used, nor are
/// open lines, which a note counts. Of a zip archive the first such workspace is read. Throws
/// InputError where the file is no such XML or is damaged.
[[nodiscard]] ForeignContours read_cvi42(const std::filesystem::path& file);

}  // namespace lv::image
