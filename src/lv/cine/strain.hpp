#pragma once

#include "lv/analysis/results.hpp"
#include "lv/anatomy/mesh_result.hpp"
#include "lv/case_file/case.hpp"
#include "lv/drawing/orientation.hpp"
#include "lv/geometry/frame.hpp"
#include "lv/strain/agreement.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lv::cine {

/// The table strain.measured. Throws InputError where it is no such table or has no line that the
/// model's regions can be compared with.
[[nodiscard]] std::vector<strain::Measured> measured_strains(const case_file::Case& c);

/// Reads all that [strain] names without following anything. Returns what there is, in words.
/// Throws InputError where images, contours and tables do not fit together.
[[nodiscard]] std::string check_strain(const case_file::Case& c);

/// The images of a cine at both ends of systole, by their numbers.
struct CinePhases {
  int end_diastole = 0, end_systole = 0;
};

/// In phases.bin of a folder, and from there. Throws RunError when it is absent or damaged.
void write_phases(const CinePhases& phases, const std::filesystem::path& folder);
[[nodiscard]] CinePhases read_phases(const std::filesystem::path& folder);

/// The file in which the strain stage leaves how the base moves, a table of heartbeat::read_motion.
inline constexpr const char* base_motion_name = "base_motion.csv";

/// Follows the cine of a case and writes
///
///   phases.bin      the images of both ends of systole; phases.json for readers
///   axial_motion.csv motion of the slices' muscle along the axis, if long-axis images show it
///   base_motion.csv how the base moves over the cycle, if they do
///   segments.csv    strain per slice, sector and AHA segment at every phase
///   rotation.csv    of every slice at every phase
///   slices.csv      how well each slice was followed, and how near to given end-systolic contours
///   volumes.csv     of the cavity, from the contours carried along
///   contours_es.csv the contours carried to end-systole
///   end_diastole.png, end_systole.png
///   strain.txt      what was found, in words
///
/// Throws InputError for images and contours that do not fit together.
void make_strain(const case_file::Case& c, const std::filesystem::path& folder);

/// What of a beat is set beside measured strains and images.
struct ModelledBeat {
  const anatomy::MeshResult& mesh;
  const heartbeat::Beat& beat;
  const analysis::BeatFields& fields;
  std::optional<geometry::Frame> frame;  ///< the model's in image space; none: it is not there
  drawing::Orientation orientation{};
};

/// Sets the strains of a beat beside the measured ones, with their agreement, and lays the model's
/// outlines over the images: strain_comparison.csv, strain_agreement.json, outlines.csv,
/// outline_distances.csv, outlines_ed.png, outlines_es.png and pictures/ (the images around the
/// heart, for the report) in `folder`. `strain` is the folder of
/// make_strain. A wall that does not lie in the images (lies_in_images) is not laid over them, and
/// AHA segments alone are compared. Returns what was found, in words; nothing if the case has no
/// measured strain.
[[nodiscard]] std::string compare_strain(const case_file::Case& c, const ModelledBeat& model,
                                         const std::filesystem::path& strain,
                                         const std::filesystem::path& folder);

}  // namespace lv::cine
