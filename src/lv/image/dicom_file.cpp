#include "lv/image/dicom_file.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/memory.hpp"
#include "lv/base/trial.hpp"
#include "lv/image/dicom_stream.hpp"
#include "lv/image/dicom_values.hpp"

#include <fmt/format.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <string_view>
#include <utility>

namespace lv::image {
namespace {

namespace fs = std::filesystem;
using gdcm::Tag;

constexpr int largest_side = 8192;   // pixels; no scanner makes larger slices
constexpr int most_frames = 100000;  // of one file
constexpr double seconds = 1e-3;     // per millisecond

/// A file read up to its pixels.
struct ParsedFile {
  gdcm::Reader reader;
  std::uintmax_t pixels_begin = 0, size = 0;  ///< [bytes]
  bool ends_early = false;
};

double cycle_length(const DicomValues& values) {
  if (const auto interval = values.number(Tag(0x0018, 0x1062)); interval && *interval > 0.0)
    return *interval * seconds;
  if (const auto rate = values.number(Tag(0x0018, 0x1088)); rate && *rate > 0.0)
    return 60.0 / *rate;
  return 0.0;
}

/// ImageType without "original or derived" and "primary or secondary".
std::string kind_of(const std::string& image_type) {
  auto at = image_type.find('\\');
  if (at != std::string::npos)
    at = image_type.find('\\', at + 1);
  return at == std::string::npos ? "" : image_type.substr(at + 1);
}

/// Magnitude, phase and the like, by both attributes that may say so; of a file or a frame.
std::string kind_of(const DicomValues& values, const Tag& type) {
  std::string kind = kind_of(values.text(type));
  if (const std::string component = values.text(Tag(0x0008, 0x9208)); !component.empty())
    kind += (kind.empty() ? "" : "\\") + component;
  return kind;
}

/// What all images of a file share.
DicomImage common(const fs::path& file, const DicomValues& values) {
  DicomImage image;
  image.file = file;
  image.series_uid = values.text(Tag(0x0020, 0x000e));
  image.description = values.text(Tag(0x0008, 0x103e));
  image.instance_uid = values.text(Tag(0x0008, 0x0018));
  image.kind = kind_of(values, Tag(0x0008, 0x0008));
  image.modality = values.text(Tag(0x0008, 0x0060));
  image.patient_id = values.text(Tag(0x0010, 0x0020));
  image.patient_name = values.text(Tag(0x0010, 0x0010));
  image.series_number = values.whole(Tag(0x0020, 0x0011));
  image.instance = values.whole(Tag(0x0020, 0x0013));
  image.rr = cycle_length(values);
  image.phases_announced = values.whole(Tag(0x0018, 0x1090)).value_or(0);
  image.plane.rows = values.binary<std::uint16_t>(Tag(0x0028, 0x0010)).value_or(0);
  image.plane.columns = values.binary<std::uint16_t>(Tag(0x0028, 0x0011)).value_or(0);
  return image;
}

/// An image of its own, as scanners wrote them before multi-frame files.
std::string read_single(const DicomValues& values, DicomImage& image) {
  if (std::string wrong =
          lay_plane(values.numbers(Tag(0x0020, 0x0032)), values.numbers(Tag(0x0020, 0x0037)),
                    values.numbers(Tag(0x0028, 0x0030)), image.plane);
      !wrong.empty())
    return wrong;
  image.thickness = values.number(Tag(0x0018, 0x0050)).value_or(0.0);
  image.temporal_position = values.whole(Tag(0x0020, 0x0100));
  if (const auto time = values.number(Tag(0x0018, 0x1060)))
    image.trigger_time = *time * seconds;
  image.slope = values.number(Tag(0x0028, 0x1053)).value_or(1.0);
  image.intercept = values.number(Tag(0x0028, 0x1052)).value_or(0.0);
  return "";
}

void read_timing(FrameGroups& groups, DicomImage& image) {
  if (const auto sync = groups.group(Tag(0x0018, 0x9118))) {
    if (const auto delay = sync->binary<double>(Tag(0x0020, 0x9153));
        delay && std::isfinite(*delay))
      image.trigger_time = *delay * seconds;
    if (const auto rr = sync->binary<double>(Tag(0x0020, 0x9251)); rr && *rr > 0.0)
      image.rr = *rr * seconds;
  }
  if (const auto content = groups.group(Tag(0x0020, 0x9111)))
    if (const auto index = content->binary<std::uint32_t>(Tag(0x0020, 0x9128)))
      image.temporal_position = static_cast<int>(*index);
}

/// One frame of an enhanced multi-frame file.
std::string read_frame(FrameGroups groups, DicomImage& image) {
  const auto numbers = [&](const Tag& group, const Tag& tag) { return groups.numbers(group, tag); };
  const Tag measures(0x0028, 0x9110);
  if (std::string wrong = lay_plane(numbers(Tag(0x0020, 0x9113), Tag(0x0020, 0x0032)),
                                    numbers(Tag(0x0020, 0x9116), Tag(0x0020, 0x0037)),
                                    numbers(measures, Tag(0x0028, 0x0030)), image.plane);
      !wrong.empty())
    return wrong;
  const auto first = [](const std::vector<double>& values, double otherwise) {
    return values.empty() ? otherwise : values.front();
  };
  image.thickness = first(numbers(measures, Tag(0x0018, 0x0050)), 0.0);
  const Tag transformation(0x0028, 0x9145);
  image.slope = first(numbers(transformation, Tag(0x0028, 0x1053)), 1.0);
  image.intercept = first(numbers(transformation, Tag(0x0028, 0x1052)), 0.0);
  read_timing(groups, image);
  if (const auto type = groups.group(Tag(0x0018, 0x9226)))
    if (std::string kind = kind_of(*type, Tag(0x0008, 0x9007)); !kind.empty())
      image.kind = std::move(kind);
  return "";
}

DicomFile read_frames(const DicomValues& values, const DicomImage& shared_header, int frames) {
  const auto per_frame = values.sequence(Tag(0x5200, 0x9230));
  if (per_frame == nullptr || static_cast<int>(per_frame->GetNumberOfItems()) != frames)
    return {{},
            "it has several frames, but not the position of each (no enhanced MR)",
            true,
            shared_header.instance};
  const auto shared = values.sequence(Tag(0x5200, 0x9229));
  std::optional<DicomValues> shared_values;
  if (shared != nullptr && shared->GetNumberOfItems() > 0)
    shared_values.emplace(shared->GetItem(1).GetNestedDataSet());
  DicomFile found;
  for (int f = 0; f < frames; ++f) {
    DicomImage image = shared_header;
    image.frame = f;
    if (frames > 1)
      image.instance = f + 1;
    const DicomValues own(per_frame->GetItem(f + 1).GetNestedDataSet());
    if (std::string wrong = read_frame(FrameGroups(own, shared_values), image); !wrong.empty())
      return {{}, fmt::format("frame {}: {}", f + 1, wrong), true, shared_header.instance};
    found.images.push_back(std::move(image));
  }
  return found;
}

/// How many bytes the pixels of all frames are, unpacked.
std::uintmax_t pixel_bytes(const DicomValues& values, const DicomImage& image, int frames) {
  const auto bits = values.binary<std::uint16_t>(Tag(0x0028, 0x0100)).value_or(16);
  return static_cast<std::uintmax_t>(image.plane.rows) *
         static_cast<std::uintmax_t>(image.plane.columns) * static_cast<std::uintmax_t>(frames) *
         bits / 8U;
}

/// Whether the file ends before its pixels do; compressed ones are tried when they are read. GDCM
/// takes zeros for what is missing.
std::string damage_of(const ParsedFile& parsed, const DicomValues& values, const DicomImage& image,
                      int frames) {
  const gdcm::TransferSyntax syntax =
      parsed.reader.GetFile().GetHeader().GetDataSetTransferSyntax();
  if (syntax.IsEncapsulated())
    return "";
  const std::uintmax_t needed = pixel_bytes(values, image, frames);
  const std::uintmax_t there = parsed.size - std::min(parsed.size, parsed.pixels_begin);
  if (parsed.ends_early && there >= needed)
    return "the file is truncated: its deflated data have no end";
  return there < needed ? fmt::format("the file is truncated: {} of {} bytes of pixels are there",
                                      there, needed)
                        : "";
}

/// What the file is whose header shows no image.
std::string without_image(const DicomImage& header) {
  if (header.modality == "RTSTRUCT")
    return "it holds contours (DICOM RTSTRUCT): name the file itself as a file of contours";
  return header.modality.empty()
             ? "it is DICOM but no image"
             : fmt::format("it is DICOM of the modality {} but no image", header.modality);
}

DicomFile read_parsed(const fs::path& file, const ParsedFile& parsed) {
  const DicomValues values(parsed.reader.GetFile().GetDataSet());
  DicomImage image = common(file, values);
  if (image.plane.rows < 2 || image.plane.columns < 2)
    return {{}, without_image(image)};
  if (image.modality == "SEG")
    return {{}, "it is a DICOM segmentation: name the file itself as a map of labels"};
  const auto lost = [&](std::string reason) {
    return DicomFile{{}, std::move(reason), true, image.instance};
  };
  if (image.plane.rows > largest_side || image.plane.columns > largest_side)
    return lost(fmt::format("it claims {} x {} pixels", image.plane.columns, image.plane.rows));
  if (values.binary<std::uint16_t>(Tag(0x0028, 0x0002)).value_or(1) != 1)
    return lost("it is an image of colours, not of grey values");
  const int frames = values.whole(Tag(0x0028, 0x0008)).value_or(1);
  if (frames < 1 || frames > most_frames)
    return lost(fmt::format("it claims {} frames", frames));
  image.damage = damage_of(parsed, values, image, frames);
  image.file_bytes = pixel_bytes(values, image, frames);
  // Some scanners add an empty per-frame sequence to images of one frame.
  if (frames > 1 || values.bytes(Tag(0x0020, 0x0032)).empty())
    if (frames > 1 || values.sequence(Tag(0x5200, 0x9230)) != nullptr)
      return read_frames(values, image, frames);
  if (std::string wrong = read_single(values, image); !wrong.empty())
    return lost(std::move(wrong));
  return {{image}, ""};
}

template <class Stored>
void append(const std::vector<char>& bytes, std::vector<float>& values) {
  const std::size_t n = bytes.size() / sizeof(Stored);
  values.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    Stored stored;
    std::memcpy(&stored, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    values.push_back(static_cast<float>(stored));
  }
}

bool append_as(const gdcm::PixelFormat& format, const std::vector<char>& bytes,
               std::vector<float>& values) {
  switch (format.GetScalarType()) {
    case gdcm::PixelFormat::UINT8:
      append<std::uint8_t>(bytes, values);
      return true;
    case gdcm::PixelFormat::INT8:
      append<std::int8_t>(bytes, values);
      return true;
    case gdcm::PixelFormat::UINT12:
    case gdcm::PixelFormat::UINT16:
      append<std::uint16_t>(bytes, values);
      return true;
    case gdcm::PixelFormat::INT12:
    case gdcm::PixelFormat::INT16:
      append<std::int16_t>(bytes, values);
      return true;
    case gdcm::PixelFormat::UINT32:
      append<std::uint32_t>(bytes, values);
      return true;
    case gdcm::PixelFormat::INT32:
      append<std::int32_t>(bytes, values);
      return true;
    case gdcm::PixelFormat::FLOAT32:
      append<float>(bytes, values);
      return true;
    case gdcm::PixelFormat::FLOAT64:
      append<double>(bytes, values);
      return true;
    default:
      return false;
  }
}

/// Makes values brighter the larger they are (PS3.3 C.7.6.3.1.2: MONOCHROME1 shows the least as
/// white), within the range of what the pixels can store, so that all images of a study agree.
void turn_over(const gdcm::PixelFormat& format, std::vector<float>& values) {
  const auto ends = static_cast<float>(format.GetMin() + format.GetMax());
  for (float& value : values)
    value = ends - value;
}

[[noreturn]] void fail_pixels(const fs::path& file, const std::string& what) {
  throw InputError(file.string(), what,
                   "Copy or export the file again; if it is broken at its source, leave its series "
                   "out");
}

/// The stored values of all frames of a file.
std::vector<float> decoded_values(const fs::path& file) {
  std::vector<float> values;
  try {
    const DicomStream stream = open_dicom(file);
    gdcm::ImageReader reader;
    reader.SetStream(*stream.bytes);
    if (!reader.Read())
      fail_pixels(file,
                  "the pixels cannot be read: the file is truncated, damaged or of an unknown "
                  "compression");
    const gdcm::Image& image = reader.GetImage();
    std::vector<char> bytes(image.GetBufferLength());
    if (!image.GetBuffer(bytes.data()))
      fail_pixels(file, "the pixels cannot be decoded: the file is truncated or damaged");
    if (image.GetPixelFormat().GetSamplesPerPixel() != 1 ||
        !append_as(image.GetPixelFormat(), bytes, values))
      fail_pixels(file, "is no image of grey values");
    if (image.GetPhotometricInterpretation() == gdcm::PhotometricInterpretation::MONOCHROME1)
      turn_over(image.GetPixelFormat(), values);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // ends the trial in the child
  } catch (const std::exception& error) {
    fail_pixels(file, fmt::format("the pixels cannot be read: {}", error.what()));
  }
  return values;
}

/// The same, tried first: GDCM as Debian builds it ends the program by an assertion on files
/// damaged in certain ways. `bytes` are those of the pixels.
std::vector<float> stored_values(const fs::path& file, std::uintmax_t bytes) {
  constexpr std::uintmax_t always = std::uintmax_t{1} << 30U;
  constexpr std::uintmax_t per_byte =
      8;  // the file, GDCM's copies of it, and floats of single bytes
  silence_gdcm();
  require_memory(file.string(), static_cast<double>(per_byte) * static_cast<double>(bytes));
  const Trial trial =
      tried([&] { static_cast<void>(decoded_values(file)); }, always + per_byte * bytes);
  if (trial.ending == Trial::Ending::refused)
    throw InputError(trial.where, trial.what, "");
  if (trial.ending == Trial::Ending::died)
    fail_pixels(file, "the pixels cannot be decoded: the file is truncated or damaged");
  return decoded_values(file);
}

DicomFile read_headers(const fs::path& file) {
  try {
    const DicomStream stream = open_dicom(file);
    ParsedFile parsed;
    parsed.reader.SetStream(*stream.bytes);
    const Tag pixels(0x7fe0, 0x0010);
    if (!parsed.reader.ReadUpToTag(pixels, {pixels}))  // and no further
      return {{}, "its DICOM header is truncated or damaged", true};
    parsed.size = stream.size;
    parsed.ends_early = stream.ends_early;
    const std::streamoff at = stream.bytes->tellg();
    parsed.pixels_begin = at < 0 ? parsed.size : static_cast<std::uintmax_t>(at);
    return read_parsed(file, parsed);
  } catch (const std::bad_alloc&) {
    throw;  // ends the trial in the child
  } catch (const std::exception& error) {
    return {{}, fmt::format("its DICOM header is damaged: {}", error.what()), true};
  }
}

/// How a child that tries a file says that its image is lost: by the InstanceNumber, or a word
/// where there is none; empty for a file that holds no image anyway.
std::string lost_as(const DicomFile& read) {
  if (!read.lost)
    return "";
  return read.instance ? std::to_string(*read.instance) : "unnumbered";
}

}  // namespace

bool looks_like_dicom(const fs::path& file) {
  std::array<char, 132> head{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), head.size());
  const auto got = stream.gcount();
  if (got == 132 && std::string_view(head.data() + 128, 4) == "DICM")
    return true;
  return got >= 8 && (head[0] == 2 || head[0] == 8) && head[1] == 0 && head[3] == 0;
}

std::string dicom_modality(const fs::path& file) {
  silence_gdcm();
  if (!unreadable(file).empty() || !looks_like_dicom(file))
    return {};
  std::string modality;
  const auto read = [&] {
    const DicomStream stream = open_dicom(file);
    gdcm::Reader reader;
    reader.SetStream(*stream.bytes);
    const Tag modality_tag(0x0008, 0x0060);
    if (reader.ReadUpToTag(modality_tag, {}))
      modality = DicomValues(reader.GetFile().GetDataSet()).text(modality_tag);
  };
  if (tried(read).ending == Trial::Ending::well)
    read();
  return modality;
}

DicomFile read_dicom_headers(const fs::path& file) {
  silence_gdcm();
  if (std::string reason = unreadable(file); !reason.empty())
    return {{}, std::move(reason)};
  if (!looks_like_dicom(file))
    return {{}, "it is not DICOM"};
  const Trial trial = tried([&] {
    if (const DicomFile read = read_headers(file); !read.reason.empty())
      throw InputError(lost_as(read), read.reason, "");
  });
  switch (trial.ending) {
    case Trial::Ending::well:
      return read_headers(file);
    case Trial::Ending::refused:
      return {{}, trial.what, !trial.where.empty(), number_of<int>(trial.where)};
    default:
      return {{}, "its DICOM header is truncated or damaged", true};
  }
}

Picture DicomPixels::read(const DicomImage& image) {
  if (!image.damage.empty())
    fail_pixels(image.file, image.damage);
  if (image.file != file_ || values_.empty()) {
    values_ = stored_values(image.file, image.file_bytes);
    file_ = image.file;
  }
  const std::size_t n = static_cast<std::size_t>(image.plane.rows) * image.plane.columns;
  const std::size_t first = n * static_cast<std::size_t>(image.frame);
  if (values_.size() < first + n)
    fail_pixels(image.file, fmt::format("holds {} values where {} x {} pixels were announced",
                                        values_.size(), image.plane.columns, image.plane.rows));
  Picture picture{image.plane, {}};
  picture.values.reserve(n);
  for (std::size_t p = first; p < first + n; ++p)
    picture.values.push_back(static_cast<float>(image.slope * values_[p] + image.intercept));
  return picture;
}

}  // namespace lv::image
