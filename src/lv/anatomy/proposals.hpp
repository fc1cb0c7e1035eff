#pragma once

#include "lv/anatomy/moments.hpp"
#include "lv/case_file/case_lines.hpp"
#include "lv/image/dicom_study.hpp"
#include "lv/image/foreign_contours.hpp"
#include "lv/image/sunnybrook.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace lv::anatomy {

/// What a case would say of its source of the anatomy, as far as the files show it: lines for the
/// choices that `said` leaves open. A user confirms them.

/// Labels and, of a map of several times, the frame.
[[nodiscard]] std::vector<case_file::CaseLine> label_lines(const image::Volume& map,
                                                           const case_file::LabelAnatomy& said);

/// Labels of the muscle that may be scar or its core: those that the file names so; where it names
/// none, those that lie within the wall beside the label that has most of the cavity's border.
struct LikelyScar {
  std::vector<int> labels;
  bool by_name = false;
};
[[nodiscard]] LikelyScar likely_scar(const image::Volume& map, const std::vector<int>& muscle);

/// The lines by which a label map named `name` shows an infarct too, if it seems to; to be
/// uncommented unless the map's own names say so. `frame` is that of the anatomy, from 1.
[[nodiscard]] std::vector<case_file::CaseLine> scar_lines(const image::Volume& map,
                                                          const std::string& name,
                                                          const std::vector<int>& muscle,
                                                          int frame);

/// A warning of labels of the muscle that may be scar, of which the case says nothing; or empty.
[[nodiscard]] std::string unsaid_scar(const case_file::Case& c, const image::Volume& map);

/// Of a file of contours of another program: which structures are the borders, where its format
/// does not fix that, and the images it needs.
[[nodiscard]] std::vector<case_file::CaseLine> contour_file_lines(
    const image::ForeignContours& drawn, const case_file::ContourFileAnatomy& said);

/// Which series of a study the contours in a folder were drawn on: of several the first, single or
/// joined by its description, that has all their images. `read` becomes the contours by phase, if
/// any can be read.
struct SunnybrookChoice {
  std::vector<case_file::CaseLine> lines;  ///< series of several, and the phase
  image::DicomStack stack;
  image::DrawnPhases read;
};
[[nodiscard]] SunnybrookChoice sunnybrook_choice(const std::filesystem::path& contours,
                                                 const image::DicomStudy& study,
                                                 const case_file::SunnybrookAnatomy& said);

/// The series that looks most like a short-axis cine: of three or more slices of five or more
/// images the one with most images. Null if there is none.
[[nodiscard]] const image::DicomStack* short_axis_cine(const image::DicomStudy& study);

/// The line that names that series.
[[nodiscard]] case_file::CaseLine short_axis_line(const std::string& parameter,
                                                  const image::DicomStudy& study);

/// The series that look like long-axis cines beside a short-axis one: one plane of five or more
/// images of the same kind (not velocities beside magnitudes), at least 60 degrees across the
/// short-axis slices, that passes the middle of the first and of the last of them within 30 mm. As
/// many as a case may name, in order of the study; without the first of several orientations in a
/// series, which no name chooses alone.
[[nodiscard]] std::vector<const image::DicomStack*> long_axis_cines(
    const image::DicomStudy& study, const image::DicomStack& short_axis);

/// The line that names those series; none where there are none.
[[nodiscard]] std::vector<case_file::CaseLine> long_axis_lines(const std::string& parameter,
                                                               const image::DicomStudy& study,
                                                               const image::DicomStack& short_axis);

}  // namespace lv::anatomy
