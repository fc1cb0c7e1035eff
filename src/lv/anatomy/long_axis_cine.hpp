#pragma once

#include "lv/case_file/case.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/picture.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace lv::anatomy {

/// Of how many long axes a case may name cines: landmarks have names for these.
inline constexpr std::size_t most_long_axes = 4;

/// Who names long-axis cines, and the short-axis images beside which they stand.
struct LongAxisNames {
  std::string parameter;   ///< "segment.long_axis_cine" or "strain.long_axis_cine"
  std::string beside;      ///< the parameter of the short-axis images, "segment.cine"
  std::string short_axis;  ///< what that one says: a file, or the folder with the series
};

/// The long-axis cine of a name: that of a file of images, or a series of the DICOM folder with the
/// short-axis images, `dicom` if that is one. Throws InputError for a name that is neither, or that
/// of several planes or of a single image.
[[nodiscard]] image::Cine read_long_axis_cine(const case_file::Case& c, const LongAxisNames& names,
                                              const std::optional<image::DicomStudy>& dicom,
                                              const std::string& name);

}  // namespace lv::anatomy
