#pragma once

#include "lv/geometry/contours.hpp"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lv::image {

/// Contours from a list of points.
struct GuidePoints {
  geometry::Contours contours;                  ///< not checked yet
  std::optional<std::array<double, 3>> septum;  ///< middle of the points on the septum's right [mm]
  std::vector<std::string> notes;
};

/// Reads a tab-separated list of points in scanner millimetres. The first line names the columns:
/// x, y, z, "contour type" (or type), slice and, if there are several times, "time frame" (or
/// frame) and weight: points of weight 0 or less are not used, all others count alike; further
/// columns are not used. The types are
///
///   SAX_LV_ENDOCARDIAL, SAX_LV_EPICARDIAL   loops on short-axis slices
///   LAX_LV_ENDOCARDIAL, LAX_LV_EPICARDIAL   curves on long-axis images
///   SAX_RV_SEPTUM                           the septum's right side: closes an open epicardium
///   MITRAL_VALVE                            points of the mitral annulus
///   APEX_ENDO_POINT, APEX_EPI_POINT         tips of the surfaces
///   APEX_POINT                              the tip of `apex_of`
///
/// and others are counted in a note. Points of a loop are put in order round their middle, those of
/// a curve round the middle of the cavity from the base over the apex to the base. An epicardium
/// that is open over more than 60 degrees is left out, with a note. `frame` must be given if there
/// are several. Throws InputError with file and line.
[[nodiscard]] GuidePoints read_guide_points(const std::filesystem::path& file,
                                            std::optional<int> frame, geometry::Side apex_of);

/// The time frames of which one must be chosen; a single one if nothing is to be chosen: one time,
/// views besides it that count their times otherwise, or no image that bears two.
[[nodiscard]] std::vector<int> guide_point_frames(const std::filesystem::path& file);

/// The contours of each of these frames that can be read.
[[nodiscard]] std::map<int, geometry::Contours> guide_point_contours(
    const std::filesystem::path& file, geometry::Side apex_of);

}  // namespace lv::image
