#pragma once

#include "lv/image/picture.hpp"
#include "lv/phantom/imaging.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lv::phantom {

/// What the headers of a study say besides what its pictures know.
struct StudyHeader {
  std::uint64_t seed = 0;  ///< identifiers follow from it
  double rr = 0.9;         ///< [s]
  double thickness = 8.0;  ///< [mm]
  double spacing = 8.0;    ///< between short-axis slices [mm]
};

/// One DICOM series.
struct Series {
  int number = 1;
  std::string description;
  image::Cine cine;
};

/// Makes the folder of a study, with one for contours in it. Throws InputError where it is there
/// and not empty, RunError where it cannot be made.
void make_study_folder(const std::filesystem::path& folder);

/// Writes one MR image object per picture, as a scanner does: position, orientation and spacing,
/// thickness, trigger time, nominal interval, study, series and frame of reference. The files'
/// names count through the series and say nothing of place and time. Throws RunError.
void write_dicom(const StudyHeader& header, const std::vector<Series>& series,
                 const std::filesystem::path& folder);

/// Writes a stack of slices as one NIfTI volume (4-D if there are several frames), with the affine
/// that lays it in scanner space. The slices must be equally spaced along their common normal.
/// Throws RunError.
void write_nifti(const image::Cine& cine, const std::filesystem::path& file);

/// The same of labels: one stack per frame.
void write_nifti(const std::vector<std::vector<LabelPicture>>& frames, double frame_time,
                 const std::filesystem::path& file);

}  // namespace lv::phantom
