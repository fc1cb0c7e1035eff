#include "lv/phantom/files.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>
#include <itkGDCMImageIO.h>
#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkMetaDataObject.h>
#include <itkNiftiImageIO.h>

#include <algorithm>
#include <cmath>

namespace lv::phantom {
namespace {

template <class Pixel>
using Volume = itk::Image<Pixel, 4>;

/// An identifier under the root for numbers (ISO/IEC 9834-8), the same for the same study.
std::string uid(std::uint64_t seed, int series, int instance) {
  return fmt::format("2.25.{}{:04d}{:06d}", 1000000000ULL + seed % 1000000000ULL, series, instance);
}

std::string decimal(double x) {
  return fmt::format("{:.10g}", x);
}

std::string triple(const Vec3& v) {
  return decimal(v.x()) + "\\" + decimal(v.y()) + "\\" + decimal(v.z());
}

/// Where one image stands in its study.
struct Instance {
  int series, number, slice, frame, of_frames;
  std::string description;
  double trigger;  ///< [s]
};

itk::MetaDataDictionary dictionary(const StudyHeader& header, const Instance& at,
                                   const image::Plane& plane) {
  constexpr const char* mr_image_storage = "1.2.840.10008.5.1.4.1.1.4";
  const std::vector<std::pair<const char*, std::string>> entries{
      {"0008|0008", "ORIGINAL\\PRIMARY\\M\\ND"},
      {"0008|0016", mr_image_storage},
      {"0008|0018", uid(header.seed, at.series, at.number)},
      {"0008|0020", "20200101"},
      {"0008|0030", "080000"},
      {"0008|0060", "MR"},
      {"0008|0070", "ventricle"},
      {"0008|103e", at.description},
      {"0010|0010", "PHANTOM"},
      {"0010|0020", fmt::format("PHANTOM{}", header.seed)},
      {"0018|0023", "2D"},
      {"0018|0050", decimal(header.thickness)},
      {"0018|0088", decimal(header.spacing)},
      {"0018|1060", decimal(1e3 * at.trigger)},
      {"0018|1062", fmt::format("{:.0f}", 1e3 * header.rr)},
      {"0018|1088", fmt::format("{:.0f}", 60.0 / header.rr)},
      {"0018|1090", std::to_string(at.of_frames)},
      {"0020|000d", uid(header.seed, 0, 0)},
      {"0020|000e", uid(header.seed, at.series, 0)},
      {"0020|0010", "1"},
      {"0020|0011", std::to_string(at.series)},
      {"0020|0012", std::to_string(at.slice)},
      {"0020|0013", std::to_string(at.number)},
      {"0020|0032", triple(plane.origin)},
      {"0020|0037", triple(plane.along_row) + "\\" + triple(plane.along_column)},
      {"0020|0052", uid(header.seed, 0, 1)},
      {"0020|1041", decimal(plane.origin.dot(plane.normal()))},
      {"0028|0002", "1"},
      {"0028|0004", "MONOCHROME2"},
      {"0028|0030", decimal(plane.spacing_j) + "\\" + decimal(plane.spacing_i)}};
  itk::MetaDataDictionary entries_of_itk;
  for (const auto& [tag, value] : entries)
    itk::EncapsulateMetaData<std::string>(entries_of_itk, tag, value);
  return entries_of_itk;
}

short whole(float value) {
  return static_cast<short>(std::clamp(std::lround(value), 0L, 32767L));
}

template <class Image>
void lay(Image& image, const image::Plane& plane, double thickness) {
  typename Image::SpacingType spacing;
  typename Image::PointType origin;
  typename Image::DirectionType direction;
  spacing.Fill(1.0);
  origin.Fill(0.0);
  direction.SetIdentity();
  spacing[0] = plane.spacing_i;
  spacing[1] = plane.spacing_j;
  spacing[2] = thickness;
  const Vec3 normal = plane.normal();
  for (unsigned d = 0; d < 3; ++d) {
    origin[d] = plane.origin[d];
    direction[d][0] = plane.along_row[d];
    direction[d][1] = plane.along_column[d];
    direction[d][2] = normal[d];
  }
  image.SetSpacing(spacing);
  image.SetOrigin(origin);
  image.SetDirection(direction);
}

template <class Image>
void write(const Image& image, itk::ImageIOBase& io, const std::filesystem::path& file) {
  const auto writer = itk::ImageFileWriter<Image>::New();
  writer->SetInput(&image);
  writer->SetImageIO(&io);
  writer->SetFileName(file.string());
  writer->SetUseCompression(file.extension() == ".gz");
  try {
    writer->Update();
  } catch (const itk::ExceptionObject& error) {
    throw RunError(fmt::format("{} cannot be written: {}", file.string(), error.GetDescription()),
                   "Check the folder's permissions and the space left on the disk");
  }
}

void write_instance(const StudyHeader& header, const Instance& at, const image::Picture& picture,
                    const std::filesystem::path& file) {
  using Slice = itk::Image<short, 3>;
  const auto image = Slice::New();
  Slice::SizeType size{};
  size[0] = picture.plane.columns;
  size[1] = picture.plane.rows;
  size[2] = 1;
  image->SetRegions(size);
  lay(*image, picture.plane, header.thickness);
  image->Allocate();
  std::transform(picture.values.begin(), picture.values.end(), image->GetBufferPointer(), whole);
  image->SetMetaDataDictionary(dictionary(header, at, picture.plane));
  const auto io = itk::GDCMImageIO::New();
  io->KeepOriginalUIDOn();
  write(*image, *io, file);
}

/// A volume of slices in order along their normal: `planes` are those of the first frame.
template <class Pixel>
typename Volume<Pixel>::Pointer volume(const std::vector<image::Plane>& planes, std::size_t frames,
                                       double frame_time) {
  LV_CHECK(!planes.empty());
  const Vec3 normal = planes.front().normal();
  const bool upward = planes.size() < 2 || (planes[1].origin - planes[0].origin).dot(normal) > 0.0;
  const double spacing =
      planes.size() < 2 ? 1.0 : std::abs((planes[1].origin - planes[0].origin).dot(normal));
  const auto image = Volume<Pixel>::New();
  typename Volume<Pixel>::SizeType size{};
  size[0] = planes.front().columns;
  size[1] = planes.front().rows;
  size[2] = planes.size();
  size[3] = frames;
  image->SetRegions(size);
  lay(*image, planes.front(), spacing);
  auto direction = image->GetDirection();
  for (unsigned d = 0; d < 3 && !upward; ++d)
    direction[d][2] = -direction[d][2];
  image->SetDirection(direction);
  auto step = image->GetSpacing();
  step[3] = frame_time;
  image->SetSpacing(step);
  image->Allocate();
  return image;
}

}  // namespace

void make_study_folder(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder))
    throw InputError(folder.string(), "is not empty", "Name a folder that does not exist yet");
  std::error_code error;
  std::filesystem::create_directories(folder / "contours", error);
  if (error)
    throw RunError(fmt::format("{} cannot be made: {}", folder.string(), error.message()),
                   "Check the permissions, or name another folder");
}

void write_dicom(const StudyHeader& header, const std::vector<Series>& series,
                 const std::filesystem::path& folder) {
  int file = 0;
  for (const Series& s : series) {
    int number = 0;
    for (std::size_t k = 0; k < s.cine.slices.size(); ++k) {
      const image::CineSlice& slice = s.cine.slices[k];
      for (std::size_t f = 0; f < slice.frames.size(); ++f) {
        const Instance at{s.number,
                          ++number,
                          static_cast<int>(k) + 1,
                          static_cast<int>(f),
                          static_cast<int>(slice.frames.size()),
                          s.description,
                          slice.times.at(f)};
        write_instance(header, at, slice.frames[f], folder / fmt::format("IM{:05d}.dcm", ++file));
      }
    }
  }
}

void write_nifti(const image::Cine& cine, const std::filesystem::path& file) {
  std::vector<image::Plane> planes;
  for (const image::CineSlice& slice : cine.slices)
    planes.push_back(slice.frames.front().plane);
  const image::CineSlice& first = cine.slices.front();
  const std::size_t frames = first.frames.size();
  const double frame_time = frames > 1 ? first.times.at(1) - first.times.at(0) : 1.0;
  const auto image = volume<short>(planes, frames, frame_time);
  short* out = image->GetBufferPointer();
  for (std::size_t f = 0; f < frames; ++f)
    for (const image::CineSlice& slice : cine.slices) {
      const std::vector<float>& values = slice.frames.at(f).values;
      out = std::transform(values.begin(), values.end(), out, whole);
    }
  write(*image, *itk::NiftiImageIO::New(), file);
}

void write_nifti(const std::vector<std::vector<LabelPicture>>& frames, double frame_time,
                 const std::filesystem::path& file) {
  std::vector<image::Plane> planes;
  for (const LabelPicture& picture : frames.front())
    planes.push_back(picture.plane);
  const auto image = volume<unsigned char>(planes, frames.size(), frame_time);
  unsigned char* out = image->GetBufferPointer();
  for (const std::vector<LabelPicture>& frame : frames)
    for (const LabelPicture& picture : frame)
      out = std::copy(picture.values.begin(), picture.values.end(), out);
  write(*image, *itk::NiftiImageIO::New(), file);
}

}  // namespace lv::phantom
