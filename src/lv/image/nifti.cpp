#include "lv/image/nifti.hpp"

#include "lv/base/check.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <itkMetaDataObject.h>
#include <itkNiftiImageIO.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

constexpr double at_right_angles = 1e-3;  // cosine between axes
constexpr double same_place = 0.1;        // of a voxel, between sform and qform
constexpr double smallest_voxel = 1e-3;   // [mm]
constexpr double largest_voxel = 1e3;
constexpr double farthest = 1e6;    // of an image from the scanner's centre [mm]
constexpr double most_bytes = 8e9;  // of voxels

[[noreturn]] void fail(const fs::path& file, const std::string& what, const std::string& remedy) {
  throw InputError(file.string(), what, remedy);
}

[[noreturn]] void fail_damaged(const fs::path& file, const std::string& what) {
  fail(file, fmt::format("cannot be read as NIfTI: {}", what),
       "The file seems to be truncated, damaged or of another kind: save or copy it again");
}

std::string first_line(const std::string& text) {
  const auto start = text.find_last_of(':');  // ITK puts file and line before its message
  const std::string message = start == std::string::npos ? text : text.substr(start + 1);
  const auto from = message.find_first_not_of(" \n");
  return from == std::string::npos ? text : message.substr(from, message.find('\n', from) - from);
}

std::string entry(const itk::ImageIOBase& io, const std::string& key) {
  std::string value;
  itk::ExposeMetaData(io.GetMetaDataDictionary(), key, value);
  return value;
}

/// The affine map of the sform from voxels to RAS, if the file has one.
std::optional<Eigen::Matrix<double, 3, 4>> sform(const itk::ImageIOBase& io) {
  std::istringstream code(entry(io, "sform_code"));
  int kind = 0;
  code >> kind;
  if (kind <= 0)
    return std::nullopt;
  Eigen::Matrix<double, 3, 4> map;
  for (int d = 0; d < 3; ++d) {
    std::istringstream row(entry(io, fmt::format("srow_{}", "xyz"[d])));
    for (int e = 0; e < 4; ++e)
      row >> map(d, e);
    if (!row)
      return std::nullopt;
  }
  return map;
}

bool has_qform(const itk::ImageIOBase& io) {
  std::istringstream code(entry(io, "qform_code"));
  int kind = 0;
  code >> kind;
  return kind > 0;
}

void check_right_angles(const fs::path& file, const Mat3& axes) {
  for (int d = 0; d < 3; ++d) {
    const double length = axes.col(d).norm();
    const double cosine =
        axes.col(d).dot(axes.col((d + 1) % 3)) / length / axes.col((d + 1) % 3).norm();
    if (!(length > 0.0) || !std::isfinite(length) || !(std::abs(cosine) < at_right_angles))
      fail(file, "its sform is sheared or flat: its axes are not at right angles",
           "Resample the image to a rectangular grid");
  }
}

/// The first bytes of a file, unpacked if it is packed.
using Head = std::array<char, 352>;

using GzFile = std::unique_ptr<gzFile_s, int (*)(gzFile)>;

GzFile open_packed(const fs::path& file) {
  GzFile stream(gzopen(file.c_str(), "rb"), gzclose);
  if (!stream)
    fail_damaged(file, "it cannot be opened");
  return stream;
}

Head head_of(const fs::path& file) {
  Head head{};
  if (gzread(open_packed(file).get(), head.data(), head.size()) < 0)
    fail_damaged(file, "it is packed, and damaged");
  return head;
}

/// How many bytes a file has, unpacked if it is packed, and all of them if asked for.
struct Unpacked {
  std::uintmax_t length = 0;
  std::vector<char> all;
};

/// Reads a file to its end: what the NIfTI library does not, which takes zeros for missing voxels.
Unpacked unpack(const fs::path& file, bool keep) {
  const GzFile stream = open_packed(file);
  Unpacked unpacked;
  std::vector<char> block(1U << 16U);
  for (;;) {
    const int got = gzread(stream.get(), block.data(), static_cast<unsigned>(block.size()));
    if (got < 0)
      fail_damaged(file, "it is packed, and damaged or truncated");
    unpacked.length += static_cast<std::uintmax_t>(got);
    if (keep)
      unpacked.all.insert(unpacked.all.end(), block.begin(), block.begin() + got);
    if (got < static_cast<int>(block.size()))
      break;
  }
  int error = Z_OK;
  gzerror(stream.get(), &error);
  if (error != Z_OK && error != Z_STREAM_END)
    fail_damaged(file, "it is packed, and truncated");
  return unpacked;
}

/// A number of the header, turned round if the file comes from a machine of the other byte order.
template <class Number>
Number header_number(const Head& head, std::size_t at) {
  std::int32_t size = 0;
  std::memcpy(&size, head.data(), sizeof(size));
  std::array<char, sizeof(Number)> bytes{};
  std::memcpy(bytes.data(), head.data() + at, sizeof(Number));
  if (size != 348)
    std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<Number>(bytes);
}

/// Refuses a header whose place in space is none: ITK would end the program.
void check_finite(const fs::path& file) {
  const Head head = head_of(file);
  std::vector<std::size_t> numbers{80, 84, 88};  // pixdim of three axes
  const auto add = [&](std::size_t from, std::size_t to) {
    for (std::size_t at = from; at < to; at += 4)
      numbers.push_back(at);
  };
  if (header_number<std::int16_t>(head, 252) > 0)
    add(256, 280);  // the qform's quaternion and offset
  if (header_number<std::int16_t>(head, 254) > 0)
    add(280, 328);  // the sform's rows
  for (const std::size_t at : numbers)
    if (!(std::abs(header_number<float>(head, at)) <= farthest))
      fail_damaged(file, fmt::format("its header has {:g} for a place or a size",
                                     header_number<float>(head, at)));
}

/// The map of the qform from voxels to RAS (the NIfTI-1 standard's method 2).
Eigen::Matrix<double, 3, 4> qform(const Head& head) {
  const auto number = [&](std::size_t at) {
    return static_cast<double>(header_number<float>(head, at));
  };
  const Vec3 v(number(256), number(260), number(264));
  const double a = std::sqrt(std::max(0.0, 1.0 - v.squaredNorm()));
  Eigen::Matrix<double, 3, 4> map;
  map.leftCols<3>() = Eigen::Quaterniond(a, v.x(), v.y(), v.z()).toRotationMatrix();
  const double handed = number(76) < 0.0 ? -1.0 : 1.0;
  for (int d = 0; d < 3; ++d)
    map.col(d) *= number(80 + 4 * d) * (d == 2 ? handed : 1.0);
  map.col(3) = Vec3(number(268), number(272), number(276));
  return map;
}

/// Lays the volume by its sform where there is one; if there is a qform too, both must agree.
void lay(const fs::path& file, const itk::ImageIOBase& io, Volume& volume) {
  const auto affine = sform(io);
  if (!affine) {
    if (!has_qform(io))
      volume.notes.push_back(fmt::format(
          "{} does not say how it lies in space (neither sform nor qform): its axes are "
          "taken to point to the left, the back and the head; if it is mirrored, so are "
          "the regions",
          file.string()));
    return;
  }
  const Mat3 to_lps = Vec3(-1.0, -1.0, 1.0).asDiagonal();
  const Mat3 axes = to_lps * affine->leftCols<3>();
  check_right_angles(file, axes);
  volume.origin = to_lps * affine->col(3);
  for (int d = 0; d < 3; ++d) {
    volume.spacing[d] = axes.col(d).norm();
    volume.directions.col(d) = axes.col(d).normalized();
  }
  if (!has_qform(io))
    return;
  const auto other = qform(head_of(file));
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 ijk((corner & 1) != 0 ? volume.size[0] - 1 : 0,
                   (corner & 2) != 0 ? volume.size[1] - 1 : 0,
                   (corner & 4) != 0 ? volume.size[2] - 1 : 0);
    const double apart = (volume.point(ijk) - to_lps * (other * ijk.homogeneous())).norm();
    if (!(apart < std::max(same_place * volume.spacing.minCoeff(), 1e-2)))
      fail(file,
           fmt::format("its sform and its qform put a corner of the image {:.1f} mm apart", apart),
           "Correct the header so that both agree, or set the code of the wrong one to 0");
  }
}

/// Sizes, spacing and place as ITK reads them.
Volume read_header(const fs::path& file, itk::NiftiImageIO& io) {
  Volume volume;
  volume.file = file.string();
  const unsigned dimensions = io.GetNumberOfDimensions();
  std::array<int, 4> size{1, 1, 1, 1};
  for (unsigned d = 0; d < dimensions; ++d) {
    const auto n = io.GetDimensions(d);
    if (d >= 4 && n > 1)
      fail(file, fmt::format("has {} dimensions", dimensions), "Save an image of three or four");
    if (n < 1 || n > 100000)
      fail_damaged(file, fmt::format("it claims {} voxels along an axis", n));
    if (d < 4)
      size[d] = static_cast<int>(n);
  }
  for (unsigned d = 0; d < std::min(dimensions, 3U); ++d) {
    volume.spacing[d] = io.GetSpacing(d);
    volume.origin[d] = io.GetOrigin(d);
    const std::vector<double> direction = io.GetDirection(d);
    for (unsigned e = 0; e < std::min<std::size_t>(direction.size(), 3); ++e)
      volume.directions(e, d) = direction[e];
  }
  volume.size = {size[0], size[1], size[2]};
  volume.frames = size[3];
  if (dimensions > 3 && volume.frames > 1 && io.GetSpacing(3) > 0.0 && io.GetSpacing(3) < 10.0)
    volume.time_step = io.GetSpacing(3);
  const double bytes = static_cast<double>(size[0]) * size[1] * size[2] * size[3] *
                       static_cast<double>(io.GetComponentSize());
  if (bytes > most_bytes)
    fail(file, fmt::format("claims {:.0f} bytes of voxels", bytes), "Crop or downsample the image");
  return volume;
}

/// Refuses voxels that are no part of a person, before anything is resampled to their size.
void check_place(const fs::path& file, const Volume& volume) {
  if (!(volume.spacing.minCoeff() >= smallest_voxel) ||
      !(volume.spacing.maxCoeff() <= largest_voxel) || !volume.origin.allFinite() ||
      volume.origin.cwiseAbs().maxCoeff() > farthest || !volume.directions.allFinite())
    fail_damaged(file, fmt::format("its voxels measure {:g} x {:g} x {:g} mm at ({:g}, {:g}, {:g}) "
                                   "mm",
                                   volume.spacing.x(), volume.spacing.y(), volume.spacing.z(),
                                   volume.origin.x(), volume.origin.y(), volume.origin.z()));
}

template <class Stored>
void append(const std::vector<char>& bytes, std::vector<float>& values) {
  const auto* stored = reinterpret_cast<const Stored*>(bytes.data());
  for (std::size_t i = 0; i < bytes.size() / sizeof(Stored); ++i)
    values.push_back(static_cast<float>(stored[i]));
}

bool append_as(itk::IOComponentEnum type, const std::vector<char>& bytes,
               std::vector<float>& values) {
  using T = itk::IOComponentEnum;
  switch (type) {
    case T::UCHAR:
      append<unsigned char>(bytes, values);
      return true;
    case T::CHAR:
      append<signed char>(bytes, values);
      return true;
    case T::USHORT:
      append<unsigned short>(bytes, values);
      return true;
    case T::SHORT:
      append<short>(bytes, values);
      return true;
    case T::UINT:
      append<unsigned int>(bytes, values);
      return true;
    case T::INT:
      append<int>(bytes, values);
      return true;
    case T::ULONG:
      append<unsigned long>(bytes, values);
      return true;
    case T::LONG:
      append<long>(bytes, values);
      return true;
    case T::ULONGLONG:
      append<unsigned long long>(bytes, values);
      return true;
    case T::LONGLONG:
      append<long long>(bytes, values);
      return true;
    case T::FLOAT:
      append<float>(bytes, values);
      return true;
    case T::DOUBLE:
      append<double>(bytes, values);
      return true;
    default:
      return false;
  }
}

/// The file of the voxels: that of the header, or beside it.
fs::path voxel_file(const fs::path& file) {
  if (file.extension() != ".hdr")
    return file;
  fs::path voxels = file;
  voxels.replace_extension(".img");
  return fs::exists(voxels) ? voxels : fs::path(voxels.string() + ".gz");
}

/// Where the voxels of a file of floating-point numbers lie among its bytes, and how.
struct Layout {
  std::size_t offset = 0;
  bool swapped = false;  ///< in the other byte order
};

/// Voxels of a file that hold no finite number.
template <class Stored>
std::vector<std::size_t> not_finite(const std::vector<char>& bytes, const Layout& layout,
                                    std::size_t voxels) {
  std::vector<std::size_t> found;
  for (std::size_t v = 0; v < voxels; ++v) {
    std::array<char, sizeof(Stored)> stored{};
    std::memcpy(stored.data(), bytes.data() + layout.offset + v * sizeof(Stored), sizeof(Stored));
    if (layout.swapped)
      std::reverse(stored.begin(), stored.end());
    if (!std::isfinite(std::bit_cast<Stored>(stored)))
      found.push_back(v);
  }
  return found;
}

/// Refuses a file that ends before its voxels do. Returns the voxels without a finite number, for
/// which the NIfTI library takes zeros.
std::vector<std::size_t> check_voxels(const fs::path& file, const Volume& volume) {
  constexpr int float32 = 16;  // datatypes of the NIfTI-1 standard
  constexpr int float64 = 64;
  const bool beside = voxel_file(file) != file;
  const Head head = head_of(file);
  const int type = header_number<std::int16_t>(head, 70);
  const int bits = header_number<std::int16_t>(head, 72);
  const auto start = header_number<float>(head, 108);
  const bool real = type == float32 || type == float64;
  const Unpacked unpacked = unpack(beside ? voxel_file(file) : file, real);
  std::int32_t size = 0;
  std::memcpy(&size, head.data(), sizeof(size));
  const Layout layout{static_cast<std::size_t>(start > 0.0F && start < 1e9F ? start : 0.0F),
                      size != 348};
  const std::size_t voxels = volume.voxels() * static_cast<std::size_t>(volume.frames);
  const std::uintmax_t needed = layout.offset + voxels * std::max(bits, 0) / 8;
  if (unpacked.length < needed)
    fail_damaged(file, fmt::format("it ends after {} of {} bytes", unpacked.length, needed));
  if (type == float32 && bits == 32)
    return not_finite<float>(unpacked.all, layout, voxels);
  if (type == float64 && bits == 64)
    return not_finite<double>(unpacked.all, layout, voxels);
  return {};
}

void read_values(const fs::path& file, itk::NiftiImageIO& io, Volume& volume) {
  itk::ImageIORegion all(io.GetNumberOfDimensions());
  for (unsigned d = 0; d < io.GetNumberOfDimensions(); ++d)
    all.SetSize(d, io.GetDimensions(d));
  io.SetIORegion(all);
  std::vector<char> buffer(volume.voxels() * static_cast<std::size_t>(volume.frames) *
                           io.GetComponentSize());
  io.Read(buffer.data());
  if (!append_as(io.GetComponentType(), buffer, volume.values))
    fail(file, "has values of an unknown type", "Save whole numbers or floating-point numbers");
}

}  // namespace

bool is_nifti_name(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.ends_with(".nii") || name.ends_with(".nii.gz") || name.ends_with(".hdr") ||
         name.ends_with(".img") || name.ends_with(".img.gz");
}

Volume read_nifti(const fs::path& file) {
  if (!fs::is_regular_file(file))
    fail(file, "there is no such file", "Check the name of the NIfTI image");
  if (!is_nifti_name(file))
    fail(file, fmt::format("has the ending \"{}\"", file.extension().string()),
         "NIfTI images end in .nii, .nii.gz, .hdr or .img");
  itk::Object::GlobalWarningDisplayOff();
  try {
    const auto io = itk::NiftiImageIO::New();
    io->SetFileName(file.string());
    if (!io->CanReadFile(file.c_str()))
      fail_damaged(file, "it has no NIfTI header");
    check_finite(file);
    io->ReadImageInformation();
    if (io->GetNumberOfComponents() != 1)
      fail(file, fmt::format("has {} values per voxel", io->GetNumberOfComponents()),
           "Give an image of grey values or labels");
    Volume volume = read_header(file, *io);
    lay(file, *io, volume);
    check_place(file, volume);
    const std::vector<std::size_t> without_value = check_voxels(file, volume);
    read_values(file, *io, volume);
    for (const std::size_t v : without_value)
      volume.values[v] = std::numeric_limits<float>::quiet_NaN();
    return volume;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    const std::string what = error.what();
    if (what.find("orthonormal") != std::string::npos)
      fail(file, "its sform is sheared or flat: its axes are not at right angles",
           "Resample the image to a rectangular grid");
    fail_damaged(file, first_line(what));
  }
}

Cine read_nifti_cine(const fs::path& file) {
  const Volume volume = read_nifti(file);
  const auto bad = std::find_if(volume.values.begin(), volume.values.end(),
                                [](float value) { return std::isnan(value); });
  if (bad != volume.values.end()) {
    const auto v = static_cast<std::size_t>(bad - volume.values.begin());
    const std::size_t in_frame = v % volume.voxels();
    fail(file,
         fmt::format("voxel ({}, {}, {}) of frame {} is not a finite number",
                     in_frame % volume.size[0], in_frame / volume.size[0] % volume.size[1],
                     in_frame / volume.size[0] / volume.size[1], v / volume.voxels() + 1),
         "Set voxels without a value to 0");
  }
  return cine_of(volume);
}

}  // namespace lv::image
