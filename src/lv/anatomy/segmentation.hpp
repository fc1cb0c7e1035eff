#pragma once

#include "lv/case_file/case.hpp"
#include "lv/geometry/landmarks.hpp"
#include "lv/segment/long_axis.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lv::anatomy {

/// A cine and the borders that the program drew in it, and its long axes with the ventricle's ends.
struct CineSegmentation {
  image::Cine cine;
  segment::Segmentation found;
  std::vector<image::CineSlice> long_axis;
  segment::LongAxisEnds ends;
};

/// The images in which a case has borders drawn.
struct Cines {
  image::Cine short_axis;
  std::vector<image::CineSlice> long_axis;  ///< as segment.long_axis_cine names them
};

/// The cine of segment.cine and those of segment.long_axis_cine. Throws InputError where the case
/// does not name the first, or a series of several, where its slices have pixels of several sizes
/// or differ in their number, and for a long axis that is none (see read_long_axis_cine) or lies
/// less than 45 degrees from the slices, or for more than four.
[[nodiscard]] Cines read_cines(const case_file::Case& c);

/// Segments such cines. Throws InputError, with `where` naming the short axis, where no ventricle
/// is found.
[[nodiscard]] CineSegmentation segment_cines(Cines cines,
                                             const segment::SegmentParameters& parameters,
                                             const std::string& where);

/// The ends of the ventricle in a frame that are not doubtful, as landmarks: apex_endo and the
/// points of the annulus. Long-axis images count on after the slices.
[[nodiscard]] std::vector<geometry::Landmark> proposed_landmarks(
    const CineSegmentation& segmentation, std::size_t frame);

/// Segments the cine of segment.cine. Throws InputError where the case does not name it, or a
/// series of several, and where no ventricle is found.
[[nodiscard]] CineSegmentation segment_cine(const case_file::Case& c);

/// The frame, from 0, of segment.moment.
[[nodiscard]] std::size_t shape_frame(const case_file::Case& c,
                                      const CineSegmentation& segmentation);

/// Volumes, phases and doubts, in words.
[[nodiscard]] std::string describe(const CineSegmentation& segmentation);

/// Writes into a folder
///
///   contours/phase_NN.csv  the borders of a phase, as anatomy.source = "contours" reads them
///   quality.csv            a row per slice and phase: areas, confidence of both borders, doubtful
///   volumes.csv            cavity and muscle per phase, areas times spacing, and doubtful_part
///   pictures/phase_NN.png  all slices of a phase with their borders, long axes with their ends
///   landmarks/phase_NN.csv proposed_landmarks, as anatomy.contours.landmarks reads them, and
///   long_axis.csv          every end with its confidence; both only where there are long axes
///   segmentation.csv       proposed phases, from 1, and segment.fall as it was used or found
///   segmentation.txt       what describe says
void write_segmentation(const CineSegmentation& segmentation, const std::filesystem::path& folder);

/// The same into a folder that is not there before it is whole. Until then its contents lie beside
/// it, under its name and ".part"; what a run that was killed left there is taken away.
void keep_segmentation(const CineSegmentation& segmentation, const std::filesystem::path& folder);

/// Where such a folder keeps the landmarks of a frame, from 0.
[[nodiscard]] std::filesystem::path landmarks_file(const std::filesystem::path& folder,
                                                   std::size_t frame);

/// segment.fall as such a folder has it; nothing where it does not say. Throws InputError for a
/// table that is damaged.
[[nodiscard]] std::optional<double> kept_fall(const std::filesystem::path& folder);

/// Segments the cine of a case into a new folder, and says what was found. Throws InputError if the
/// folder exists, for contours in it may have been corrected.
[[nodiscard]] std::string segment_case(const case_file::Case& c,
                                       const std::filesystem::path& folder);

}  // namespace lv::anatomy
