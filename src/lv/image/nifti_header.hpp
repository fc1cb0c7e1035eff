#pragma once

#include "lv/base/tensor.hpp"

#include <array>
#include <optional>
#include <span>

namespace lv::image {

/// The header of a NIfTI-1 or NIfTI-2 file, numbers as they stand there
/// (https://nifti.nimh.nih.gov).
struct NiftiHeader {
  std::size_t length = 348;     ///< bytes; 540 in NIfTI-2
  bool swapped = false;         ///< all numbers are in the other byte order
  bool beside = false;          ///< the voxels stand in a file of their own
  std::array<double, 8> dim{};  ///< dim[0] dimensions of dim[1], dim[2], ... voxels
  int datatype = 0, bits = 0;   ///< of a voxel
  std::array<double, 8> pixdim{};
  double voxels_begin = 0.0;  ///< byte of the file that they stand in
  double slope = 0.0, intercept = 0.0;
  int units = 0;                       ///< of length and time
  int qform_code = 0, sform_code = 0;  ///< above 0 if there is one
  Vec3 quaternion = Vec3::Zero();      ///< of the qform: b, c, d
  Vec3 offset = Vec3::Zero();          ///< of the qform
  Eigen::Matrix<double, 3, 4> rows = Eigen::Matrix<double, 3, 4>::Zero();  ///< of the sform
};

/// The longest header.
inline constexpr std::size_t longest_nifti_header = 540;

/// Reads the header that stands in a file's first bytes; none if there is none. Analyze 7.5, which
/// has the same length but does not say how it lies in space, has none.
[[nodiscard]] std::optional<NiftiHeader> parse_nifti_header(std::span<const char> bytes);

/// Whether the bytes are the header of an Analyze 7.5 file.
[[nodiscard]] bool is_analyze_header(std::span<const char> bytes);

}  // namespace lv::image
