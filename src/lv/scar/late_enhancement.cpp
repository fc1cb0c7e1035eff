#include "lv/scar/late_enhancement.hpp"

#include "lv/base/check.hpp"
#include "lv/base/log.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/volume_file.hpp"

#include <fmt/format.h>

#include <array>

namespace lv::scar {

image::Cine read_late_enhancement(const case_file::Case& c) {
  const mesh::LateEnhancement& lge = c.scar.lge;
  const std::string file = case_file::beside(c, lge.image).string();
  image::Cine image = image::is_volume_name(file)
                          ? image::read_volume_cine(file)
                          : image::read_dicom_cine(std::array{std::filesystem::path(file)},
                                                   lge.series, "infarct.lge.series");
  for (const image::CineSlice& slice : image.slices)
    if (slice.frames.size() != 1)
      throw InputError(
          file, fmt::format("{} has {} images of different times", slice.name, slice.frames.size()),
          "A late-enhancement image has one for each slice: choose the series");
  for (const std::string& note : image.notes)
    log::warn("late enhancement: {}", note);
  return image;
}

}  // namespace lv::scar
