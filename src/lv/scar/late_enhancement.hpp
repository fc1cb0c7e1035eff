#pragma once

#include "lv/case_file/case.hpp"
#include "lv/image/picture.hpp"

namespace lv::scar {

/// The late-enhancement image of infarct.lge.image, one picture per slice. Throws InputError where
/// it cannot be read, is not chosen among several series, or has several times.
[[nodiscard]] image::Cine read_late_enhancement(const case_file::Case& c);

}  // namespace lv::scar
