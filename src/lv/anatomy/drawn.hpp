#pragma once

#include "lv/anatomy/segmentation.hpp"
#include "lv/case_file/case.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/geometry/fit_report.hpp"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lv::anatomy {

/// The borders of a ventricle that a case names, whatever their form: contours, labels, guide
/// points.
struct Drawn {
  geometry::Contours contours;                            ///< checked
  std::string source;                                     ///< in words
  std::optional<double> label_cavity, label_muscle;       ///< volumes of voxels [mm^3]
  std::optional<std::array<double, 3>> septum;            ///< if the source shows where it is [mm]
  geometry::BaseAt usual_base = geometry::BaseAt::slice;  ///< unless the case says otherwise
  std::shared_ptr<const CineSegmentation> segmentation;   ///< of borders that the program drew
  std::vector<std::string> notes;
  /// Of the moment with the smallest cavity, where the source shows it besides.
  std::optional<geometry::Contours> end_systole;
  bool moment_is_known = false;  ///< it was chosen among several
  /// Of an end-diastolic shape that is taken as free of stress, a base that cuts the cavity, slices
  /// that are alike, borders that the program drew (segment::warnings_of_drawn).
  std::vector<geometry::Assumption> warnings;
};

/// Reads what the case names. Throws InputError naming file, slice and remedy; where a choice is
/// missing (labels, frame, phase), with what there is to choose from.
[[nodiscard]] Drawn read_drawn(const case_file::Case& c);

/// Volume of the endocardial loops of one phase [mm^3]; 0 where it cannot be told.
[[nodiscard]] double volume_of(const geometry::Contours& contours);

/// "phase 1: 9 endo, 0 epi, 141.30 ml" and so on, a line each, with a proposal of phases; they may
/// be called something else.
[[nodiscard]] std::string describe_phases(const std::map<int, geometry::Contours>& phases,
                                          const std::string& called = "phase");

/// The volume at each frame and the phases proposed from it.
[[nodiscard]] std::string describe_volume_curve(const std::vector<double>& volumes);

}  // namespace lv::anatomy
