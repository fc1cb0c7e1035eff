#pragma once

#include "lv/image/picture.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lv::test {

/// One DICOM image as a scanner writes it (explicit VR, little endian), 16-bit pixels.
struct DicomSpec {
  image::Plane plane;
  std::vector<std::uint16_t> pixels;  ///< rows x columns
  std::string series_uid = "1.2.3.4";
  std::string instance_uid = "1.2.3.4.1";
  std::string description = "cine";
  std::string kind = "M";  ///< the third value of ImageType, and of FrameType in an enhanced file
  std::string component;   ///< ComplexImageComponent of a frame; may be empty
  int phases = 0;          ///< CardiacNumberOfImages; not written if 0
  int series_number = 1;
  int instance = 1;
  bool numbered = true;  ///< whether the InstanceNumber is written
  std::string patient;   ///< PatientID; not written if empty
  std::optional<double> trigger_ms;
  int rr_ms = 800;
  double slope = 1.0, intercept = 0.0;
  std::string photometric = "MONOCHROME2";
};

[[nodiscard]] std::string dicom_bytes(const DicomSpec& spec);

/// The same in big-endian byte order.
[[nodiscard]] std::string big_endian_dicom_bytes(const DicomSpec& spec);

/// The same with all but the first elements deflated.
[[nodiscard]] std::string deflated_dicom_bytes(const DicomSpec& spec);

/// The frames of one enhanced multi-frame file; all but plane, pixels, trigger_ms, kind and
/// component are those of the first.
[[nodiscard]] std::string enhanced_dicom_bytes(const std::vector<DicomSpec>& frames);

/// One NIfTI file of 8-bit or floating-point values.
struct NiftiSpec {
  std::array<int, 4> size{1, 1, 1, 1};
  std::array<std::array<double, 4>, 3> sform{};  ///< voxels to RAS [mm]
  int sform_code = 1;
  int qform_code = 0;
  bool same_qform = false;  ///< the qform is the sform's map; else its rotation is the identity
  std::optional<std::array<double, 3>> pixdim;  ///< if not the lengths of the sform's columns
  double time_step = 0.04;
  int units = 2 | 8;  ///< mm, s
  int version = 1;    ///< of NIfTI
  bool floating = false;
  float slope = 0.0F, intercept = 0.0F;
  std::vector<double> values;
};

[[nodiscard]] std::string nifti_bytes(const NiftiSpec& spec);

/// A label map of a ventricle in image space: `label(x)` at the centre of each voxel (LPS).
[[nodiscard]] NiftiSpec label_map(const std::array<int, 3>& size, const Mat3& directions,
                                  const Vec3& spacing, const Vec3& origin,
                                  const std::function<int(const Vec3&)>& label);

}  // namespace lv::test
