#pragma once

#include "lv/image/picture.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lv::image {

/// What the header of one DICOM image says; of a multi-frame file, of one of its frames.
struct DicomImage {
  std::filesystem::path file;
  int frame = 0;             ///< in the file, from 0
  std::string series_uid;    ///< SeriesInstanceUID
  std::string description;   ///< SeriesDescription
  std::string instance_uid;  ///< SOPInstanceUID
  std::string kind;          ///< ImageType (of a frame FrameType) from its third value on, and
                             ///< ComplexImageComponent: magnitude, phase, ...
  std::string modality;
  std::string patient_id, patient_name;  ///< to tell patients apart: never shown
  std::optional<int> series_number;
  std::optional<int> instance;  ///< InstanceNumber; of a file of several frames the frame from 1
  std::optional<int> temporal_position;  ///< TemporalPositionIdentifier or -Index
  std::optional<double> trigger_time;    ///< after the R wave [s]
  Plane plane;
  int phases_announced = 0;  ///< CardiacNumberOfImages; 0 if not said
  double thickness = 0.0;    ///< of the slice; 0 if not said [mm]
  double rr = 0.0;           ///< NominalInterval, else 60 s over HeartRate; 0 if not said [s]
  double slope = 1.0, intercept = 0.0;  ///< value = slope stored + intercept
  std::uintmax_t file_bytes = 0;        ///< of the pixels of all frames of the file, unpacked
  std::string damage;                   ///< why its pixels cannot be read; empty if they can
};

/// The images of a file, or why it has none that lie in space.
struct DicomFile {
  std::vector<DicomImage> images;
  std::string reason;  ///< empty if there are images
  bool lost = false;   ///< whether it would be an image but for the reason, or is damaged
  std::optional<int> instance{};  ///< InstanceNumber of a lost image, if it says one
};

/// Whether a file begins as DICOM files do: "DICM" after the preamble, or for old files without one
/// an element of the first groups.
[[nodiscard]] bool looks_like_dicom(const std::filesystem::path& file);

/// The Modality of a DICOM file, images or not ("MR", "SEG", "RTSTRUCT"); empty for other files and
/// damaged ones.
[[nodiscard]] std::string dicom_modality(const std::filesystem::path& file);

/// Reads the headers alone. Never throws for what the file holds: a file that is no DICOM image
/// says so in `reason`. Multi-frame files must have their frames' positions in functional groups
/// (enhanced MR).
[[nodiscard]] DicomFile read_dicom_headers(const std::filesystem::path& file);

/// Reads pixels, file after file; frames of one file in a row cost one reading.
class DicomPixels {
 public:
  /// The values after rescaling. Throws InputError naming the file if it is truncated, damaged or
  /// no image of grey values.
  [[nodiscard]] Picture read(const DicomImage& image);

 private:
  std::filesystem::path file_;
  std::vector<float> values_;  ///< of all frames, as stored
};

}  // namespace lv::image
