#pragma once

#include "lv/case_file/case_lines.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/image/volume.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lv::anatomy {

/// The moments of the heart beat that a source of the anatomy shows, and which they seem to be.
struct Moments {
  std::vector<int> numbers;               ///< as the case file counts them, in order of time
  std::vector<double> volumes;            ///< of the cavity [mm^3]
  int end_diastole = 0, end_systole = 0;  ///< numbers, by largest and smallest volume
  /// After end-systole (see image::propose_phases); none where too few moments are shown.
  std::optional<int> early_diastole;

  [[nodiscard]] double volume(int number) const;  ///< [mm^3]
};

/// Of a label map: the frames that show the cavity, counted from 1.
[[nodiscard]] Moments moments_of(const image::Volume& map, const std::vector<int>& cavity);

/// Of contours by phase or frame: those with two endocardial loops or more.
[[nodiscard]] Moments moments_of(const std::map<int, geometry::Contours>& drawn);

/// The line that chooses a moment: early diastole where it is shown, whose shape is taken as free
/// of stress; else end-diastole. `parameter` is that of the frame or phase.
[[nodiscard]] case_file::CaseLine choice(const std::string& parameter, const Moments& moments);

/// For a shape that is (or is likely to be) of end-diastole.
[[nodiscard]] case_file::CaseLine unloading_line(const std::string& comment);

/// What to know of a case whose shape is the end-diastolic one of several and is taken as free of
/// stress; empty for others.
[[nodiscard]] std::string end_diastole_note(const case_file::Case& c, const Moments& moments,
                                            int chosen);

/// The same of a shape that is known to be that of end-diastole; `which`: how, in words.
[[nodiscard]] std::string end_diastole_note(const case_file::Case& c, const std::string& which);

}  // namespace lv::anatomy
