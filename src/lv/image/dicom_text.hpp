#pragma once

#include <string>
#include <string_view>

namespace lv::image {

/// A text of a DICOM file as UTF-8, by its SpecificCharacterSet (PS3.3 C.12.1.1.2):
///
///   absent       ASCII; bytes beyond it are UTF-8 if they can be, else ISO 8859-1, which is what
///                scanners write that do not say
///   ISO_IR 6     the same
///   ISO_IR 100   ISO 8859-1
///   ISO_IR 192   UTF-8
///   others       ASCII alone is read; what else stands there is shown as "?", once for a run
[[nodiscard]] std::string dicom_text(std::string_view stored, std::string_view character_set);

}  // namespace lv::image
