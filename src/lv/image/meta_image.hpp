#pragma once

#include "lv/image/volume.hpp"

#include <filesystem>

namespace lv::image {

/// Reads a MetaImage (.mha, .mhd with its voxels beside; https://itk.org/Wiki/MetaIO) of grey
/// values or labels, of two to four dimensions. Offset and TransformMatrix are in LPS, as ITK and
/// what is built on it write them, in millimetres unless DistanceUnits says otherwise. The format
/// has no unit of time: of several frames the times are not known. Throws InputError where the file
/// is damaged or holds colours or vectors; RunError if it is larger than memory.
[[nodiscard]] Volume read_meta_image(const std::filesystem::path& file);

}  // namespace lv::image
