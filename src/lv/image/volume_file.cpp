#include "lv/image/volume_file.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/formats.hpp"
#include "lv/base/lines.hpp"
#include "lv/image/dicom_segmentation.hpp"
#include "lv/image/meta_image.hpp"
#include "lv/image/nifti.hpp"
#include "lv/image/nrrd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace lv::image {
namespace {

namespace fs = std::filesystem;

/// A format of voxels that is told by its first bytes; NIfTI, which may be packed, is told apart.
struct Format {
  bool (*begins)(std::string_view);
  Volume (*read)(const fs::path&);
};

bool begins_as_nrrd(std::string_view bytes) {
  return bytes.starts_with("NRRD000");
}

bool begins_as_meta_image(std::string_view bytes) {
  const bool has_key = bytes.find("ElementDataFile") != std::string_view::npos;
  return has_key && (bytes.starts_with("ObjectType") || bytes.starts_with("NDims") ||
                     bytes.starts_with("Comment"));
}

constexpr std::array<Format, 2> formats_of_voxels{
    {{begins_as_nrrd, read_nrrd}, {begins_as_meta_image, read_meta_image}}};

const Format* format_of(const fs::path& file) {
  constexpr std::size_t enough = 16384;
  const std::string begin = first_bytes(file, enough);
  const auto* found = std::find_if(formats_of_voxels.begin(), formats_of_voxels.end(),
                                   [&](const Format& format) { return format.begins(begin); });
  return found == formats_of_voxels.end() ? nullptr : found;
}

/// Refuses headers that name their voxels by a pattern ("slice%03d.raw"): a run could not tell
/// whether they have changed since.
void check_voxels_named(const fs::path& header) {
  if (ending_of(header) != ".nhdr" && ending_of(header) != ".mhd")
    return;
  for (LineReader lines(header); lines.next();)
    if (const std::string_view line = lines.text();
        (line.starts_with("data") || line.starts_with("ElementDataFile")) &&
        line.find('%') != std::string_view::npos)
      throw InputError(lines.where(), "names its voxels by a pattern of numbered files",
                       "Save them in a single file");
}

}  // namespace

bool is_volume_name(const fs::path& file) {
  const std::string ending = ending_of(file);
  return is_nifti_name(file) || ending == ".nrrd" || ending == ".nhdr" || ending == ".mha" ||
         ending == ".mhd";
}

bool holds_volume(const fs::path& file) {
  return format_of(file) != nullptr || (is_nifti_name(file) && holds_nifti(file));
}

Volume read_volume(const fs::path& file) {
  require_readable(file, "Check the name of the file");
  check_voxels_named(file);
  if (const Format* format = format_of(file); format != nullptr)
    return format->read(file);
  if (is_nifti_name(file))
    return read_nifti(file);
  if (is_volume_name(file))
    throw InputError(file.string(), "does not begin as NRRD and MetaImage files do",
                     "The file seems to be damaged: save or copy it again");
  throw InputError(file.string(),
                   fmt::format("has the unknown ending \"{}\"", file.extension().string()),
                   fmt::format("Label maps and images are read from {}", formats::volumes));
}

Volume read_labels(const fs::path& file) {
  return holds_dicom_segmentation(file) ? read_dicom_segmentation(file) : read_volume(file);
}

Cine read_volume_cine(const fs::path& file) {
  const Volume volume = read_volume(file);
  const auto bad = std::find_if(volume.values.begin(), volume.values.end(),
                                [](float value) { return std::isnan(value); });
  if (bad != volume.values.end()) {
    const auto v = static_cast<std::size_t>(bad - volume.values.begin());
    const std::size_t in_frame = v % volume.voxels();
    throw InputError(
        file.string(),
        fmt::format("voxel ({}, {}, {}) of frame {} is not a finite number",
                    in_frame % volume.size[0], in_frame / volume.size[0] % volume.size[1],
                    in_frame / volume.size[0] / volume.size[1], v / volume.voxels() + 1),
        "Set voxels without a value to 0");
  }
  return cine_of(volume);
}

}  // namespace lv::image
