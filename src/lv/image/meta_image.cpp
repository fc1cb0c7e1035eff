#include "lv/image/meta_image.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/memory.hpp"
#include "lv/base/trial.hpp"
#include "lv/image/place.hpp"

#include <fmt/format.h>
#include <metaImage.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>
#include <string_view>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

/// The file as the library of the format reads it, which says on the terminal alone that voxels are
/// missing.
void read_all(const fs::path& file, MetaImage& meta) {
  std::streambuf* const out = std::cout.rdbuf(nullptr);
  std::stringbuf complaints;
  std::streambuf* const err = std::cerr.rdbuf(&complaints);
  const bool read = meta.Read(file.c_str());
  std::cout.rdbuf(out);
  std::cerr.rdbuf(err);
  std::cout.clear();
  std::cerr.clear();
  if (!read || meta.ElementData() == nullptr || !complaints.str().empty())
    throw InputError(file.string(), "cannot be read as MetaImage",
                     "The file seems to be truncated or damaged; the voxels of a .mhd must lie "
                     "beside it: save or copy it again");
}

/// How many bytes the voxels take by the words of the header.
double claimed_bytes(const MetaImage& meta) {
  double voxels = meta.ElementNumberOfChannels();
  for (int d = 0; d < meta.NDims(); ++d)
    voxels *= meta.DimSize(d);
  return voxels * sizeof(double);
}

/// Whether the header has any of these keys.
bool states(const fs::path& file, std::initializer_list<std::string_view> keys) {
  constexpr std::size_t enough = 16384;
  const std::string text = first_bytes(file, enough);
  for (const std::string_view line : fields_of(text, '\n'))
    for (const std::string_view key : keys)
      if (line.starts_with(key) && trimmed(line.substr(key.size())).starts_with('='))
        return true;
  return false;
}

void set_sizes(const MetaImage& meta, Volume& volume) {
  const int dimensions = meta.NDims();
  if (dimensions < 2 || dimensions > 4)
    throw InputError(volume.file, fmt::format("has {} dimensions", dimensions),
                     "Save an image of three or four");
  if (meta.ElementNumberOfChannels() != 1)
    throw InputError(volume.file,
                     fmt::format("has {} values per voxel, as colours or vectors",
                                 meta.ElementNumberOfChannels()),
                     "Give an image of grey values or labels");
  for (int d = 0; d < dimensions; ++d)
    if (meta.DimSize(d) < 1)
      throw InputError(volume.file, fmt::format("claims {} voxels along an axis", meta.DimSize(d)),
                       "The file seems to be damaged: save it again");
  volume.size = {meta.DimSize(0), meta.DimSize(1), dimensions > 2 ? meta.DimSize(2) : 1};
  volume.frames = dimensions > 3 ? meta.DimSize(3) : 1;
}

/// [mm]
double unit_of(const MetaImage& meta) {
  switch (meta.DistanceUnits()) {
    case MET_DISTANCE_UNITS_UM:
      return 1e-3;
    case MET_DISTANCE_UNITS_CM:
      return 10.0;
    default:
      return 1.0;
  }
}

/// Throws InputError for a negative size: some programs mean a mirrored axis by it, which is what
/// TransformMatrix is for, others nothing.
void check_sizes(const MetaImage& meta, const Volume& volume) {
  const int n = std::min(meta.NDims(), 3);
  for (int d = 0; d < n; ++d)
    if (meta.ElementSpacing(d) < 0.0)
      throw InputError(volume.file,
                       fmt::format("has the negative voxel size {:g} (ElementSpacing, axis {})",
                                   meta.ElementSpacing(d), d + 1),
                       "Give sizes without a sign; where the axis runs the other way, turn the "
                       "sign of its direction in TransformMatrix: else the heart may be mirrored");
}

void lay_volume(const MetaImage& meta, Volume& volume) {
  check_sizes(meta, volume);
  const int n = meta.NDims();
  const double unit = unit_of(meta);
  Affine map = Affine::Identity();
  for (int d = 0; d < std::min(n, 3); ++d) {
    for (int e = 0; e < std::min(n, 3); ++e)
      map(e, d) = unit * meta.ElementSpacing(d) * meta.TransformMatrix()[d * n + e];
    map(d, 3) = unit * meta.Offset()[d];
  }
  if (!map.allFinite())
    throw InputError(volume.file, "has a place that is no number",
                     "Correct Offset, TransformMatrix and ElementSpacing");
  lay(map, "TransformMatrix", meta.DistanceUnitsName(), volume);
}

}  // namespace

Volume read_meta_image(const fs::path& file) {
  require_readable(file, "Check the name of the file");
  check_survives(file.string(), [&] {
    MetaImage tried;
    read_all(file, tried);
  });
  MetaImage meta;
  read_all(file, meta);
  Volume volume;
  volume.file = file.string();
  set_sizes(meta, volume);
  if (!states(file, {"ElementSpacing", "ElementSize"}))
    throw InputError(volume.file,
                     "does not say how large its voxels are: it has no line ElementSpacing",
                     "Save it again with the sizes of its voxels, or write the line");
  lay_volume(meta, volume);
  require_memory(volume.file, claimed_bytes(meta));
  const auto count = volume.voxels() * static_cast<std::size_t>(volume.frames);
  volume.values.reserve(count);
  for (std::size_t v = 0; v < count; ++v) {
    const auto value = static_cast<float>(meta.ElementData(static_cast<std::streamoff>(v)));
    volume.values.push_back(std::isfinite(value) ? value : std::numeric_limits<float>::quiet_NaN());
  }
  if (!states(file, {"TransformMatrix", "Orientation", "Rotation"}))
    volume.notes.push_back(
        fmt::format("{} does not state its axes (TransformMatrix): they are taken to point to the "
                    "left, the back and the head; if it is mirrored, so are the regions",
                    volume.file));
  if (volume.frames > 1)
    volume.notes.push_back(fmt::format(
        "{}: MetaImage states no unit of time: the times of its {} frames are taken as not known",
        volume.file, volume.frames));
  return volume;
}

}  // namespace lv::image
