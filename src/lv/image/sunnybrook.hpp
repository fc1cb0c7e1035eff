#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/image/dicom_study.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lv::image {

/// Where pixel coordinates have their origin: (0, 0) is the outer corner of the first pixel, whose
/// centre is then (0.5, 0.5), or its centre.
enum class PixelOrigin { corner, centre };

/// Who drew the contours, as the file names say.
enum class DrawnBy { manual, automatic };

/// Contours of several phases in the Sunnybrook form.
struct DrawnPhases {
  /// By phase, counted from 1 in order of time on each slice; slices are counted from 1 along the
  /// stack's normal. Not checked yet (see geometry::check_contours).
  std::map<int, geometry::Contours> phases;
  std::vector<std::string> notes;
};

/// Whether a folder, or one below it, holds files that are named as such contours are. Throws
/// InputError if it may not be read.
[[nodiscard]] bool has_sunnybrook_names(const std::filesystem::path& folder);

/// Reads text contours IM-SSSS-NNNN-icontour-manual.txt (endocardium) and ocontour (epicardium):
/// one point "x y" a line in pixels, x along the row from the left, y down from the top, from the
/// folder and its subfolders (i-contours, o-contours). NNNN is the InstanceNumber of the DICOM
/// image, whose header says slice, plane and time. Contours of papillary muscles (p1contour,
/// p2contour) and of the other observer are counted in a note. Throws InputError naming the file,
/// and the line, where an image is missing (and which files were left out) or not unique, a border
/// is drawn twice, or a point is no two numbers or lies outside its image, or slices with contours
/// have different numbers of images.
[[nodiscard]] DrawnPhases read_sunnybrook(const std::filesystem::path& folder,
                                          const DicomStack& stack, PixelOrigin origin,
                                          DrawnBy drawn_by);

}  // namespace lv::image
