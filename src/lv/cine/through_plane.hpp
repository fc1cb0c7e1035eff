#pragma once

#include "lv/base/table.hpp"
#include "lv/case_file/case.hpp"
#include "lv/cine/cine.hpp"
#include "lv/strain/axial_motion.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lv::cine {

/// A short-axis slice whose images went along with its muscle.
struct AxialSlice {
  int slice = 0;
  Vec3 centre = Vec3::Zero();  ///< of the cavity at end-diastole, image space [mm]
  double height = 0.0;         ///< above the endocardial apex at end-diastole [mm]
  double beyond = 0.0;         ///< how far its muscle left the stack [mm]
};

/// What long-axis cines tell of motion through the short-axis planes.
struct ThroughPlane {
  strain::AxialMotion axial;
  std::vector<AxialSlice> slices;
  std::vector<image::CineSlice> images;  ///< of each slice's muscle
  std::vector<strain::SliceTask> tasks;  ///< to follow these; they point to `images`
};

/// Follows the long-axis views of a study and makes images that go along with each slice's muscle,
/// from the slices with contours, which are first moved to where two or more views put them
/// (geometry::slice_shifts). Nothing without views.
[[nodiscard]] std::optional<ThroughPlane> follow_through_planes(
    const case_file::Case& c, const CineStudy& study, std::vector<strain::SliceTask> tasks);

/// Columns: slice, phase, height_mm (above the endocardial apex at end-diastole),
/// axial_displacement_mm (towards the base positive), residual_mm (root mean square of what the
/// fitted motion leaves of that seen on the long axes).
[[nodiscard]] Table axial_table(const ThroughPlane& through);

/// How the base moves over the cycle from end-diastole on, a table of heartbeat::read_motion: axial
/// motion and tilts are those that the fitted motion has at the base plane in the middle of the
/// slice next to it, the rotation is given for every image [rad].
[[nodiscard]] Table base_motion_table(const ThroughPlane& through,
                                      const strain::Orientation& orientation,
                                      const std::vector<double>& rotation);

/// How far base and apex moved until end-systole, and slices that left the stack.
[[nodiscard]] std::string words_of(const ThroughPlane& through, int systole);

}  // namespace lv::cine
