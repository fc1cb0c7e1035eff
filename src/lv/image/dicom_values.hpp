#pragma once

#include "lv/image/picture.hpp"

#include <gdcmDataSet.h>
#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmTag.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What the readers of DICOM files share; needs GDCM's headers.
namespace lv::image {

/// GDCM speaks on the terminal unless told not to.
void silence_gdcm();

/// A data set's values by tag; absent and unreadable values alike are none. It must outlive them.
class DicomValues {
 public:
  explicit DicomValues(const gdcm::DataSet& set) : set_(&set) {}

  [[nodiscard]] std::string_view bytes(const gdcm::Tag& tag) const;

  /// A text as UTF-8 (see dicom_text), made safe to show.
  [[nodiscard]] std::string text(const gdcm::Tag& tag) const;

  /// Numbers written as text (DS, IS); none if one cannot be read.
  [[nodiscard]] std::vector<double> numbers(const gdcm::Tag& tag) const;

  [[nodiscard]] std::optional<double> number(const gdcm::Tag& tag) const;
  [[nodiscard]] std::optional<int> whole(const gdcm::Tag& tag) const;

  /// A number stored as it is (US, UL, FD).
  template <class Number>
  [[nodiscard]] std::optional<Number> binary(const gdcm::Tag& tag) const {
    const std::string_view stored = bytes(tag);
    if (stored.size() < sizeof(Number))
      return std::nullopt;
    Number value;
    std::memcpy(&value, stored.data(), sizeof(Number));
    return value;
  }

  /// The items of a sequence; null if there is none.
  [[nodiscard]] gdcm::SmartPointer<gdcm::SequenceOfItems> sequence(const gdcm::Tag& tag) const;

 private:
  const gdcm::DataSet* set_;
};

/// Lets `use` look at the values of a file, read up to what pixels it may have. Throws InputError
/// with the remedy where its DICOM data are truncated or damaged, also as GDCM finds while they are
/// looked at.
void with_data_set(const std::filesystem::path& file, const std::string& remedy,
                   const std::function<void(const DicomValues&)>& use);

/// The functional groups of one frame: its own, else those that all frames share.
class FrameGroups {
 public:
  FrameGroups(const DicomValues& own, const std::optional<DicomValues>& shared)
      : own_(own), shared_(shared) {}

  /// The first item of a group; none if neither has it.
  [[nodiscard]] std::optional<DicomValues> group(const gdcm::Tag& tag);

  /// Numbers of the first item of a group; none if there are none.
  [[nodiscard]] std::vector<double> numbers(const gdcm::Tag& group, const gdcm::Tag& tag);

 private:
  DicomValues own_;
  std::optional<DicomValues> shared_;
  std::vector<gdcm::SmartPointer<gdcm::SequenceOfItems>> kept_;
};

/// Lays a plane by ImagePositionPatient, ImageOrientationPatient and PixelSpacing; empty if fine,
/// else what is wrong.
[[nodiscard]] std::string lay_plane(const std::vector<double>& position,
                                    const std::vector<double>& orientation,
                                    const std::vector<double>& spacing, Plane& plane);

}  // namespace lv::image
