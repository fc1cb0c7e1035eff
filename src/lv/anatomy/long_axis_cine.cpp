#include "lv/anatomy/long_axis_cine.hpp"

#include "lv/base/check.hpp"
#include "lv/base/formats.hpp"
#include "lv/case_file/parameters.hpp"
#include "lv/image/volume_file.hpp"

#include <fmt/format.h>

#include <vector>

namespace lv::anatomy {

image::Cine read_long_axis_cine(const case_file::Case& c, const LongAxisNames& names,
                                const std::optional<image::DicomStudy>& dicom,
                                const std::string& name) {
  const std::string place = case_file::place_of(c, names.parameter);
  const bool single_file = image::is_volume_name(name);
  if (!single_file && !dicom)
    throw InputError(
        place,
        fmt::format("\"{}\" is no file of an image, and {} is no DICOM folder", name, names.beside),
        fmt::format("Name files of {}, or series of the folder {}", formats::volumes,
                    names.beside));
  image::Cine cine = single_file
                         ? image::read_volume_cine(case_file::beside(c, name))
                         : image::read_pixels(image::choose_stack(
                               *dicom, std::vector{name},
                               case_file::beside(c, names.short_axis).string(), names.parameter));
  if (cine.slices.size() != 1 || cine.slices.front().frames.size() < 2)
    throw InputError(place,
                     fmt::format("\"{}\" has {} planes of {} images", name, cine.slices.size(),
                                 cine.slices.front().frames.size()),
                     "Name cines of one long-axis plane each, of two or more images");
  return cine;
}

}  // namespace lv::anatomy
