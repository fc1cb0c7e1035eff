#pragma once

#include "lv/image/volume.hpp"

#include <filesystem>

namespace lv::image {

/// Reads a NIfTI image (.nii, .nii.gz, .hdr with .img) of grey values or labels, of two to four
/// dimensions, any axis order and direction, scl_slope and scl_inter applied. Its place is that of
/// the sform, else of the qform, turned from RAS to LPS; if it has both they must agree. A file
/// with neither is taken to have its axes along L, P and S, which a note says. Throws InputError if
/// the file is absent, truncated or damaged, sheared (its axes not at right angles), not in a known
/// unit of length, or of colours or vectors.
[[nodiscard]] Volume read_nifti(const std::filesystem::path& file);

/// The slices of a NIfTI image over time; see cine_of.
[[nodiscard]] Cine read_nifti_cine(const std::filesystem::path& file);

/// Whether a name ends as NIfTI files' do.
[[nodiscard]] bool is_nifti_name(const std::filesystem::path& file);

}  // namespace lv::image
