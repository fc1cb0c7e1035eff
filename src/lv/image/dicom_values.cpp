#include "lv/image/dicom_values.hpp"

#include "lv/base/check.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/printable.hpp"
#include "lv/image/dicom_stream.hpp"
#include "lv/image/dicom_text.hpp"

#include <fmt/format.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

namespace lv::image {

using gdcm::Tag;

namespace {

std::optional<double> finite_number_of(std::string_view text) {
  const auto value = number_of<double>(trimmed(text));
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace

void silence_gdcm() {
  static const bool once = [] {
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    gdcm::Trace::DebugOff();
    return true;
  }();
  static_cast<void>(once);
}

void with_data_set(const std::filesystem::path& file, const std::string& remedy,
                   const std::function<void(const DicomValues&)>& use) {
  try {
    const DicomStream stream = open_dicom(file);
    gdcm::Reader reader;
    reader.SetStream(*stream.bytes);
    if (!reader.Read())
      throw InputError(file.string(), "cannot be read: its DICOM data are truncated or damaged",
                       remedy);
    use(DicomValues(reader.GetFile().GetDataSet()));
  } catch (const InputError&) {
    throw;
  } catch (const RunError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // ends the trial in the child
  } catch (const std::exception& error) {
    throw InputError(file.string(),
                     fmt::format("cannot be read: its DICOM data are damaged: {}", error.what()),
                     remedy);
  }
}

std::string_view DicomValues::bytes(const Tag& tag) const {
  if (!set_->FindDataElement(tag))
    return {};
  const gdcm::ByteValue* value = set_->GetDataElement(tag).GetByteValue();
  return value == nullptr || value->GetPointer() == nullptr
             ? std::string_view()
             : std::string_view(value->GetPointer(), value->GetLength());
}

std::string DicomValues::text(const Tag& tag) const {
  return printable(dicom_text(trimmed(bytes(tag)), bytes(Tag(0x0008, 0x0005))));
}

std::vector<double> DicomValues::numbers(const Tag& tag) const {
  std::vector<double> values;
  std::string_view rest = bytes(tag);
  while (!rest.empty()) {
    const auto end = rest.find('\\');
    const auto value = finite_number_of(rest.substr(0, end));
    if (!value)
      return {};
    values.push_back(*value);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  }
  return values;
}

std::optional<double> DicomValues::number(const Tag& tag) const {
  const auto values = numbers(tag);
  return values.empty() ? std::nullopt : std::optional(values.front());
}

std::optional<int> DicomValues::whole(const Tag& tag) const {
  const auto value = number(tag);
  if (!value || std::abs(*value) > 2e9)
    return std::nullopt;
  return static_cast<int>(std::lround(*value));
}

gdcm::SmartPointer<gdcm::SequenceOfItems> DicomValues::sequence(const Tag& tag) const {
  return set_->FindDataElement(tag) ? set_->GetDataElement(tag).GetValueAsSQ() : nullptr;
}

std::optional<DicomValues> FrameGroups::group(const Tag& tag) {
  for (const DicomValues* values : {&own_, shared_ ? &*shared_ : nullptr}) {
    if (values == nullptr)
      continue;
    const auto items = values->sequence(tag);
    if (items != nullptr && items->GetNumberOfItems() > 0) {
      kept_.push_back(items);  // it owns the data set
      return DicomValues(items->GetItem(1).GetNestedDataSet());
    }
  }
  return std::nullopt;
}

std::vector<double> FrameGroups::numbers(const Tag& group_tag, const Tag& tag) {
  const auto values = group(group_tag);
  return values ? values->numbers(tag) : std::vector<double>();
}

std::string lay_plane(const std::vector<double>& position, const std::vector<double>& orientation,
                      const std::vector<double>& spacing, Plane& plane) {
  constexpr double cosine_error = 1e-2;  // of direction cosines
  constexpr double least_pixel = 1e-3;   // [mm]; smaller ones are damage
  constexpr double most_pixel = 1e3;
  constexpr double farthest_image = 1e6;  // of an image from the scanner's centre [mm]
  if (position.size() != 3)
    return "it has no ImagePositionPatient";
  if (orientation.size() != 6)
    return "it has no ImageOrientationPatient";
  if (spacing.size() != 2 || !(spacing[0] > 0.0) || !(spacing[1] > 0.0))
    return "it has no PixelSpacing above zero";
  if (std::min(spacing[0], spacing[1]) < least_pixel ||
      std::max(spacing[0], spacing[1]) > most_pixel)
    return fmt::format("its PixelSpacing is {:g} x {:g} mm", spacing[0], spacing[1]);
  const Vec3 row(orientation[0], orientation[1], orientation[2]);
  const Vec3 column(orientation[3], orientation[4], orientation[5]);
  if (std::abs(row.norm() - 1.0) > cosine_error || std::abs(column.norm() - 1.0) > cosine_error ||
      std::abs(row.dot(column)) > cosine_error)
    return "its ImageOrientationPatient holds no two unit vectors at right angles";
  plane.origin = Vec3(position[0], position[1], position[2]);
  if (plane.origin.cwiseAbs().maxCoeff() > farthest_image)
    return "its ImagePositionPatient is no place in a scanner";
  plane.along_row = row.normalized();
  plane.along_column = (column - column.dot(plane.along_row) * plane.along_row).normalized();
  plane.spacing_j = spacing[0];  // between rows comes first
  plane.spacing_i = spacing[1];
  return "";
}

}  // namespace lv::image
