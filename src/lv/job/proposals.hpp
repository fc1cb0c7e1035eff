#pragma once

#include "lv/image/dicom_study.hpp"
#include "lv/image/sunnybrook.hpp"
#include "lv/job/case_lines.hpp"
#include "lv/job/moments.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lv::job {

/// What a case would say of its source of the anatomy, as far as the files show it: lines for the
/// choices that `said` leaves open. A user confirms them.

/// Labels and, of a map of several times, the frame.
[[nodiscard]] std::vector<CaseLine> label_lines(const image::Volume& map, const LabelAnatomy& said);

/// Which series of a study the contours in a folder were drawn on: of several the first, single or
/// joined by its description, that has all their images. `read` becomes the contours by phase, if
/// any can be read.
struct SunnybrookChoice {
  std::vector<CaseLine> lines;  ///< series of several, and the phase
  image::DicomStack stack;
  image::DrawnPhases read;
};
[[nodiscard]] SunnybrookChoice sunnybrook_choice(const std::filesystem::path& contours,
                                                 const image::DicomStudy& study,
                                                 const SunnybrookAnatomy& said);

/// The series that looks most like a short-axis cine: of three or more slices of five or more
/// images the one with most images. Null if there is none.
[[nodiscard]] const image::DicomStack* short_axis_cine(const image::DicomStudy& study);

}  // namespace lv::job
