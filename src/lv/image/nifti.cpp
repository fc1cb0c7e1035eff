#include "lv/image/nifti.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/memory.hpp"
#include "lv/image/nifti_header.hpp"
#include "lv/image/nifti_place.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <span>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& what, const std::string& remedy) {
  throw InputError(file.string(), what, remedy);
}

[[noreturn]] void fail_damaged(const fs::path& file, const std::string& what) {
  fail(file, fmt::format("cannot be read as NIfTI: {}", what),
       "The file seems to be truncated, damaged or of another kind: save or copy it again");
}

/// The endings of a pair of files, header and voxels.
constexpr std::array<const char*, 2> header_endings{".hdr", ".hdr.gz"};
constexpr std::array<const char*, 2> voxel_endings{".img", ".img.gz"};

bool ends_as(const fs::path& file, const std::array<const char*, 2>& endings) {
  const std::string name = lower_case(file.filename().string());
  return std::any_of(endings.begin(), endings.end(),
                     [&](const char* ending) { return name.ends_with(ending); });
}

/// The other file of a pair, in whatever case its ending is written.
fs::path other_of_pair(const fs::path& file, const std::array<const char*, 2>& endings) {
  fs::path stem = lower_case(file.extension().string()) == ".gz" ? file.stem() : file.filename();
  stem.replace_extension();
  const FolderFiles beside = files_in(file.parent_path().empty() ? "." : file.parent_path(), false);
  for (const char* ending : endings)
    for (const fs::path& candidate : beside.files) {
      const std::string name = candidate.filename().string();
      if (name.starts_with(stem.string()) &&
          lower_case(name.substr(stem.string().size())) == ending)
        return file.parent_path() / candidate.filename();
    }
  fail(file, fmt::format("{}{} is not beside it", stem.string(), endings.front()),
       "Header (.hdr) and voxels (.img) are two files of one name in one folder: give both");
}

/// A file that is packed by gzip or not, read from its beginning.
class Stream {
 public:
  explicit Stream(const fs::path& file)
      : file_(file), stream_(gzopen(file.c_str(), "rb"), gzclose) {
    if (!stream_)
      fail_damaged(file, "it cannot be opened");
  }

  /// Fills as much of the block as the file still holds; returns how many bytes.
  std::size_t read(std::span<char> block) {
    const int got = gzread(stream_.get(), block.data(), static_cast<unsigned>(block.size()));
    int error = Z_OK;
    gzerror(stream_.get(), &error);
    if (got < 0 || (error != Z_OK && error != Z_STREAM_END))
      fail_damaged(file_, "it is packed, and damaged or truncated");
    read_ += static_cast<std::uintmax_t>(got);
    return static_cast<std::size_t>(got);
  }

  [[nodiscard]] std::uintmax_t bytes_read() const { return read_; }
  [[nodiscard]] bool is_packed() const { return gzdirect(stream_.get()) == 0; }

 private:
  fs::path file_;
  std::unique_ptr<gzFile_s, int (*)(gzFile)> stream_;
  std::uintmax_t read_ = 0;
};

NiftiHeader read_header(const fs::path& file) {
  std::array<char, longest_nifti_header> bytes{};
  Stream stream(file);
  const std::span<const char> head(bytes.data(), stream.read(bytes));
  if (const auto header = parse_nifti_header(head))
    return *header;
  if (is_analyze_header(head))
    fail(file, "is Analyze 7.5, whose header does not say how the image lies in space",
         "Save it as NIfTI");
  fail_damaged(file, "it has no NIfTI header");
}

/// Sizes of the volume, and how its frames follow each other.
Volume sized(const fs::path& file, const NiftiHeader& header) {
  constexpr double most = 100000;  // along an axis
  constexpr double most_voxels = 1e15;
  Volume volume;
  volume.file = file.string();
  const double dimensions = header.dim[0];
  if (!(dimensions >= 1 && dimensions <= 7))
    fail_damaged(file, fmt::format("it claims {:g} dimensions", dimensions));
  std::array<int, 8> size{1, 1, 1, 1, 1, 1, 1, 1};
  double voxels = 1.0;
  for (int d = 1; d <= static_cast<int>(dimensions); ++d) {
    if (!(header.dim[d] >= 1 && header.dim[d] <= most))
      fail_damaged(file, fmt::format("it claims {:g} voxels along an axis", header.dim[d]));
    size[d] = static_cast<int>(header.dim[d]);
    voxels *= size[d];
  }
  if (voxels > most_voxels)
    fail_damaged(file, fmt::format("it claims {:g} voxels", voxels));
  if (size[5] > 1)
    fail(file, fmt::format("has {} values per voxel", size[5]),
         "Give an image of grey values or labels");
  if (size[6] > 1 || size[7] > 1)
    fail(file, fmt::format("has {:g} dimensions", dimensions), "Save an image of three or four");
  volume.size = {size[1], size[2], size[3]};
  volume.frames = size[4];
  return volume;
}

/// Seconds per unit of time (the NIfTI standard's xyzt_units, bits 3 to 5).
double seconds_of(const NiftiHeader& header) {
  switch (header.units & 0x38) {
    case 16:
      return 1e-3;
    case 24:
      return 1e-6;
    default:
      return 1.0;
  }
}

/// The time between frames, if they can be those of one heart's cycle.
void set_time_step(const NiftiHeader& header, Volume& volume) {
  constexpr double longest_cycle = 5.0;  // [s]
  const double step = header.pixdim[4] * seconds_of(header);
  if (volume.frames == 1 || !(step > 0.0))
    return;
  if (step * volume.frames <= longest_cycle)
    volume.time_step = step;
  else
    volume.notes.push_back(
        fmt::format("{} says that its {} frames follow each other after {:g} s, which is no "
                    "heart's cycle: their times are taken as not known",
                    volume.file, volume.frames, step));
}

/// Appends stored numbers; none for those that are not finite.
template <class Stored>
void append(std::span<const char> bytes, bool swapped, std::vector<float>& values) {
  for (std::size_t at = 0; at + sizeof(Stored) <= bytes.size(); at += sizeof(Stored)) {
    std::array<char, sizeof(Stored)> stored{};
    std::memcpy(stored.data(), bytes.data() + at, sizeof(Stored));
    if (swapped)
      std::reverse(stored.begin(), stored.end());
    const auto value = static_cast<float>(std::bit_cast<Stored>(stored));
    values.push_back(std::isfinite(value) ? value : std::numeric_limits<float>::quiet_NaN());
  }
}

/// A type of voxels that is read (the NIfTI standard's datatype).
struct Type {
  int code;
  std::size_t bytes;
  void (*append)(std::span<const char>, bool, std::vector<float>&);
};

constexpr std::array<Type, 10> types{{{2, 1, append<std::uint8_t>},
                                      {4, 2, append<std::int16_t>},
                                      {8, 4, append<std::int32_t>},
                                      {16, 4, append<float>},
                                      {64, 8, append<double>},
                                      {256, 1, append<std::int8_t>},
                                      {512, 2, append<std::uint16_t>},
                                      {768, 4, append<std::uint32_t>},
                                      {1024, 8, append<std::int64_t>},
                                      {1280, 8, append<std::uint64_t>}}};

const Type& type_of(const fs::path& file, const NiftiHeader& header) {
  constexpr int rgb = 128;
  constexpr int rgba = 2304;
  const auto* type = std::find_if(types.begin(), types.end(),
                                  [&](const Type& t) { return t.code == header.datatype; });
  if (type == types.end())
    fail(file,
         header.datatype == rgb || header.datatype == rgba
             ? "holds colours"
             : fmt::format("holds voxels of the type {}, which is not read", header.datatype),
         "Give an image of grey values or labels, as whole or floating-point numbers");
  if (header.bits != static_cast<int>(8 * type->bytes))
    fail_damaged(
        file, fmt::format("it claims {} bits for a voxel of {} bytes", header.bits, type->bytes));
  return *type;
}

/// The byte at which the voxels begin.
std::uintmax_t voxels_begin(const fs::path& file, const NiftiHeader& header) {
  constexpr double largest = 1e9;
  constexpr std::size_t flag = 4;  // of extensions, behind the header
  if (!(header.voxels_begin >= 0.0 && header.voxels_begin < largest))
    fail_damaged(file, fmt::format("its voxels begin at byte {:g}", header.voxels_begin));
  const auto begin = static_cast<std::uintmax_t>(header.voxels_begin);
  return header.beside ? begin : std::max<std::uintmax_t>(begin, header.length + flag);
}

/// value = slope stored + intercept, if the header has a slope. Labels that went through a slope
/// are whole numbers but for its rounding.
void scale(const fs::path& file, const NiftiHeader& header, std::vector<float>& values) {
  constexpr double rounding = 1e-5;
  if (std::isnan(header.slope) || header.slope == 0.0 ||
      (header.slope == 1.0 && header.intercept == 0.0))
    return;
  if (!std::isfinite(header.slope) || !std::isfinite(header.intercept))
    fail_damaged(file, fmt::format("it multiplies its values by {:g} and adds {:g}", header.slope,
                                   header.intercept));
  for (float& value : values) {
    const double scaled = header.slope * value + header.intercept;
    const double whole = std::round(scaled);
    value = static_cast<float>(
        std::abs(scaled - whole) < rounding * std::max(1.0, std::abs(whole)) ? whole : scaled);
  }
}

/// Reads the voxels, and the file to its end, where a packed one holds its checksum.
void read_values(const fs::path& file, const NiftiHeader& header, const Type& type,
                 Volume& volume) {
  constexpr double best_packing = 1032;            // what gzip can make a byte of
  constexpr double in_memory = 2 * sizeof(float);  // as a volume and as slices
  const double voxels = 1.0 * volume.size[0] * volume.size[1] * volume.size[2] * volume.frames;
  const std::uintmax_t begin = voxels_begin(file, header);
  const double needed = static_cast<double>(begin) + voxels * static_cast<double>(type.bytes);
  std::error_code ignored;
  if (best_packing * static_cast<double>(fs::file_size(file, ignored)) >= needed) {
    require_memory(file.string(), voxels * in_memory);
    volume.values.reserve(static_cast<std::size_t>(voxels));
  }
  Stream stream(file);
  std::vector<char> block(std::size_t{1} << 16U);
  for (std::uintmax_t left = begin; left > 0;) {
    const auto got = stream.read({block.data(), std::min<std::uintmax_t>(left, block.size())});
    if (got == 0)
      break;
    left -= got;
  }
  for (;;) {
    const std::size_t got = stream.read(block);
    const auto missing = static_cast<std::size_t>(voxels) - volume.values.size();
    type.append({block.data(), std::min(got, missing * type.bytes)}, header.swapped, volume.values);
    if (got < block.size())
      break;
  }
  if (static_cast<double>(volume.values.size()) < voxels)
    fail_damaged(file,
                 fmt::format("it ends after {} of {:.0f} bytes", stream.bytes_read(), needed));
  if (stream.is_packed() && !lower_case(file.string()).ends_with(".gz"))
    volume.notes.push_back(
        fmt::format("{} is packed: name it .gz, for other programs do not look", file.string()));
}

}  // namespace

bool is_nifti_name(const fs::path& file) {
  const std::string name = lower_case(file.filename().string());
  return name.ends_with(".nii") || name.ends_with(".nii.gz") || ends_as(file, header_endings) ||
         ends_as(file, voxel_endings);
}

bool holds_nifti(const fs::path& file) {
  std::array<char, longest_nifti_header> bytes{};
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> stream(gzopen(file.c_str(), "rb"), gzclose);
  const int got = stream ? gzread(stream.get(), bytes.data(), bytes.size()) : 0;
  return got > 0 && parse_nifti_header({bytes.data(), static_cast<std::size_t>(got)});
}

Volume read_nifti(const fs::path& file) {
  require_readable(file, "Check the name of the NIfTI image");
  const bool voxels_named = ends_as(file, voxel_endings);
  const fs::path header_file = voxels_named ? other_of_pair(file, header_endings) : file;
  const NiftiHeader header = read_header(header_file);
  const Type& type = type_of(file, header);
  Volume volume = sized(file, header);
  set_time_step(header, volume);
  lay_by_header(header, volume);
  const fs::path voxels = voxels_named    ? file
                          : header.beside ? other_of_pair(file, voxel_endings)
                                          : file;
  read_values(voxels, header, type, volume);
  scale(file, header, volume.values);
  return volume;
}

}  // namespace lv::image
