#pragma once

#include "lv/base/table.hpp"
#include "lv/image/picture.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace lv::drawing {

/// The part of an image around the heart.
struct PictureFile {
  std::string state;         ///< end_diastole or end_systole
  std::string slice;         ///< number of a short-axis slice, or "long axis 1" and so on
  int phase = 0;             ///< number of the image, from 1
  image::Picture picture{};  ///< cut already
};

/// The part of an image around points, with 18 mm to spare; all of it without points.
[[nodiscard]] image::Picture cut_around(const image::Picture& picture,
                                        const std::vector<Vec3>& points);

/// Grey values from the darkest (0) to all but the brightest 1% (255), row by row.
[[nodiscard]] std::vector<unsigned char> grey_levels(const image::Picture& picture);

/// Writes each picture as a grey 8-bit PNG into `folder` and where its pixels lie as pictures.csv:
/// state, slice, phase, file, columns, rows, spacing_i_mm, spacing_j_mm, then origin_*_mm (centre
/// of the first pixel), along_row_* and along_column_* in image space, as image::Plane has them.
/// Nothing of the person but the pixels is kept. Throws RunError naming a file that cannot be
/// written.
void write_pictures(const std::vector<PictureFile>& pictures, const std::filesystem::path& folder);

/// A picture of pictures.csv as the page shows it.
struct ShownPicture {
  std::string state, slice;  ///< as in PictureFile
  int phase = 0;
  std::filesystem::path file;
  image::Plane plane{};
};

/// What write_pictures wrote; files that are not there are left out, and all are if there is no
/// pictures.csv.
[[nodiscard]] std::vector<ShownPicture> read_pictures(const std::filesystem::path& folder);

}  // namespace lv::drawing
