#pragma once

#include "lv/case_file/case.hpp"
#include "lv/draw/enhancement.hpp"
#include "lv/draw/greys.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/geometry/landmarks.hpp"
#include "lv/segment/segment.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lv::draw {

/// The closed lines of each phase.
using Lines = std::vector<std::vector<geometry::Contour>>;

/// How sure the program is of a border that it proposed; see segment::FrameBorders.
struct Confidence {
  int slice = 0, phase = 0;  ///< from 1
  double endo = 0.0, epi = 0.0;
};

/// What the program proposes.
struct Proposal {
  Lines lines;
  std::vector<geometry::Landmark> landmarks;
  std::size_t landmark_frame = 0;  ///< whose they are: that of segment.moment
  std::vector<Confidence> confidence;
  std::vector<std::string> doubts;
  double fall = 0.0;  ///< at which the endocardium was drawn (segment::draw_borders)
};

/// What observer and program have drawn in a cine.
struct Drawing {
  Lines lines;
  std::vector<geometry::Landmark> landmarks;
  std::vector<Confidence> confidence;
};

/// A long-axis image over the cycle.
struct LongAxisImage {
  image::CineSlice cine;
  Greys greys;  ///< its own: another acquisition
};

/// A cine with its borders, and where they are kept.
struct Study {
  std::string name;  ///< of the case
  case_file::Case settings;
  std::filesystem::path folder;  ///< of the drawing
  image::Cine cine;
  Greys greys;           ///< of the darkest and brightest thousandth
  double spacing = 0.0;  ///< between slices [mm]
  Proposal proposal;
  Drawing drawing;
  std::vector<LongAxisImage> long_axis;
  std::optional<Enhancement> enhancement;
  bool saved = false;     ///< the drawing comes from its folder
  std::string hindrance;  ///< why nothing can be saved; empty if it can
  int revision = 0;       ///< grows with each time it is saved, or read again
  /// Fingerprints of the drawing's files as they were read or written last, by their places.
  std::map<std::filesystem::path, std::string> files;

  [[nodiscard]] std::size_t phases() const { return cine.slices.front().frames.size(); }
  /// How many pictures bear a number: the slices and, counted on, the long-axis images.
  [[nodiscard]] std::size_t pictures() const { return cine.slices.size() + long_axis.size(); }
  /// That of a number from 1 to pictures().
  [[nodiscard]] const image::CineSlice& picture(int number) const {
    const auto at = static_cast<std::size_t>(number - 1);
    return at < cine.slices.size() ? cine.slices[at] : long_axis.at(at - cine.slices.size()).cine;
  }
};

/// The cine of segment.cine with the borders that are kept in `folder`, or, if there is no such
/// folder, those that the program proposes: from CASE.segment beside the case file, which is made
/// if it is absent and can be. Where no ventricle is found there is a doubt and no border. Throws
/// InputError where the case does not name the cine, `folder` is a file, or a folder holds borders
/// of another cine, or landmarks that lie on no image.
[[nodiscard]] Study open_study(const case_file::Case& c, const std::filesystem::path& folder);

/// A file that save would replace and that is not, by its content, as the study read or wrote it
/// last: another program or a hand has been there. Nothing if there is none.
[[nodiscard]] std::optional<std::filesystem::path> changed_elsewhere(const Study& study);

/// Reads the drawing's folder again if something of it has changed elsewhere. Throws InputError as
/// open_study does.
void catch_up(Study& study);

/// What check_contours would refuse of single slices, in sentences: "slice 3, phases 1-4: the
/// endocardium crosses itself".
[[nodiscard]] std::vector<std::string> faults_of(const Lines& lines);

/// The phase, from 1, of segment.moment by the volumes of the drawing (areas times spacing).
[[nodiscard]] int shape_phase(const Study& study);

/// Segments again, round a point of the ventricle's blood [image space, mm].
[[nodiscard]] Proposal propose(const Study& study, const Vec3& centre);

/// Writes into the study's folder
///
///   contours/phase_NN.csv  the borders of a phase, as anatomy.source = "contours" reads them
///   landmarks.csv          points that an observer named, as anatomy.contours.landmarks reads them
///   apex_endo.csv, apex_epi.csv  those of the tip, as anatomy.contours.apex_endo reads them
///   quality.csv            confidence of the proposal that the drawing started from
///   volumes.csv            cavity and muscle per phase, areas times spacing
///
/// and the scar, if there is one to keep (see write_scar), all at once (see whole_save), and takes
/// them for the study's, whatever changed_elsewhere says. Throws RunError when a file cannot be
/// written; then nothing has changed, or, if a written one cannot be moved to its place, the next
/// save or start goes on with that.
void save(Study& study, Drawing drawing, std::optional<ScarDrawing> scar = {});

}  // namespace lv::draw
