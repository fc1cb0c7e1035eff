#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>

namespace lv::image {

/// The bytes of a DICOM file, and how many there are.
struct DicomStream {
  std::unique_ptr<std::istream> bytes;
  std::uintmax_t size = 0;
  bool ends_early = false;  ///< deflated data without their end
};

/// Opens a file. The data set of a deflated one (transfer syntax 1.2.840.10008.1.2.1.99, DICOM
/// PS3.5 A.5) is inflated, as far as it goes, and its header says Explicit VR Little Endian: GDCM
/// takes some short ones for cut, and what is asked of plain files is asked of it too.
[[nodiscard]] DicomStream open_dicom(const std::filesystem::path& file);

}  // namespace lv::image
