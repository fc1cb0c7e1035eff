#pragma once

#include "lv/image/volume.hpp"

#include <filesystem>

namespace lv::image {

/// Reads a NIfTI-1 or NIfTI-2 image (.nii, .nii.gz, .hdr with .img, packed or not whatever the
/// name) of grey values or labels, of two to four dimensions, any axis order and direction, in any
/// unit of length, scl_slope and scl_inter applied. For its place see lay_by_header. Voxels that
/// hold no finite number become NaN. Throws InputError if the file cannot be read, is truncated or
/// damaged, or of colours or vectors; RunError if it is larger than memory.
[[nodiscard]] Volume read_nifti(const std::filesystem::path& file);

/// Whether a name ends as NIfTI files' do, in small or capital letters.
[[nodiscard]] bool is_nifti_name(const std::filesystem::path& file);

/// Whether a file that can be read begins, unpacked, as NIfTI files do.
[[nodiscard]] bool holds_nifti(const std::filesystem::path& file);

}  // namespace lv::image
