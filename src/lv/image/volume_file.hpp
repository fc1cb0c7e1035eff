#pragma once

#include "lv/image/volume.hpp"

#include <filesystem>

namespace lv::image {

/// Files of voxels, of whatever format: one registry. The format is known from a file's content.

/// Whether a name ends as those of such files do, in small or capital letters: .nii, .nii.gz, .hdr,
/// .img, .nrrd, .nhdr, .mha, .mhd.
[[nodiscard]] bool is_volume_name(const std::filesystem::path& file);

/// Whether a file that can be read holds voxels in one of the formats, whatever its name.
[[nodiscard]] bool holds_volume(const std::filesystem::path& file);

/// Reads an image of grey values or labels: NIfTI (see read_nifti), NRRD (read_nrrd), MetaImage
/// (read_meta_image). Throws InputError, which says what the file is, if it is none of these.
[[nodiscard]] Volume read_volume(const std::filesystem::path& file);

/// The same of a map of labels, which may also be a DICOM segmentation (read_dicom_segmentation).
[[nodiscard]] Volume read_labels(const std::filesystem::path& file);

/// The slices of an image over time; see cine_of. Throws InputError for a voxel without a finite
/// number.
[[nodiscard]] Cine read_volume_cine(const std::filesystem::path& file);

}  // namespace lv::image
