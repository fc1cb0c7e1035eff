#pragma once

#include "lv/image/dicom_study.hpp"
#include "lv/image/sunnybrook.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lv::image {

/// A closed line that another program keeps in its file.
struct ForeignLoop {
  std::string name;          ///< what the file calls the structure
  std::string image_uid;     ///< SOPInstanceUID of the image it was drawn on; empty if not stated
  int phase = 0;             ///< counted from 1; 0 if not stated
  std::vector<Vec3> points;  ///< image space (LPS) [mm]; in pixels (i, j, 0) if the file has pixels
};

/// All of a file, as it stands there.
struct ForeignContours {
  std::string file, format;
  bool in_pixels = false;  ///< of the images: without them nothing has a place
  std::vector<ForeignLoop> loops;
  std::string endo, epi;  ///< names of the left ventricle's borders, where the format fixes them
  std::vector<std::string> notes;
  std::map<std::string, std::string> not_read{};  ///< structures without a loop: what they have
  int end_diastole = 0;  ///< the phase that the file marks as such; 0: none
};

/// Whether a file holds contours in a format of read_contours, by its content.
[[nodiscard]] bool holds_contours(const std::filesystem::path& file);

/// Reads contours that were drawn in another program, in whatever of these formats: Segment's .mat
/// (read_segment_mat), DICOM RTSTRUCT (read_rt_structures), workspaces of cvi42 (read_cvi42).
/// Throws InputError for other files.
[[nodiscard]] ForeignContours read_contours(const std::filesystem::path& file);

/// The structures of a file and how many loops each has.
[[nodiscard]] std::map<std::string, int> structures(const ForeignContours& drawn);

/// A line each: name, loops, times. Ends with a new line.
[[nodiscard]] std::string describe(const ForeignContours& drawn);

/// The borders of the two structures by phase, slices counted from 1. With `images` slice and phase
/// are those of the image that a loop names; else the phase is the file's, or 1, and slices are
/// told apart by their planes, in order along their normal. Throws InputError where a structure or
/// an image is absent, a loop that is in pixels names no image, one in space lies off its image, a
/// border of one slice is drawn twice at one time, or the two structures are one or exchanged.
[[nodiscard]] DrawnPhases arranged(const ForeignContours& drawn, const std::string& endo,
                                   const std::string& epi, const DicomStack* images);

}  // namespace lv::image
