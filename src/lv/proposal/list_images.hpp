#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lv::proposal {

/// What to look at besides the images.
struct ListOptions {
  std::filesystem::path where;           ///< a folder or a file
  std::filesystem::path contours = {};   ///< folder of Sunnybrook contours; may be empty
  std::vector<std::string> series = {};  ///< that the contours were drawn on
  std::vector<int> cavity = {};          ///< labels whose volume curve is asked for; may be empty
};

/// Says what images there are, so that a case file can name them: series of DICOM files with
/// slices, phases, spacing, orientation and heart rate; size, spacing and labels of NIfTI files;
/// volumes of labels or contours over time with proposed phases; of contours, guide points, meshes
/// and other files what they are. A folder without DICOM images is listed by its NIfTI files. Ends
/// with the lines by which a case uses it. Throws InputError for what cannot be read, saying what
/// it is.
[[nodiscard]] std::string list_images(const ListOptions& options);

}  // namespace lv::proposal
