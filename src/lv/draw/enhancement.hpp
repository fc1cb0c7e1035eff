#pragma once

#include "lv/case_file/case.hpp"
#include "lv/draw/greys.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/image/picture.hpp"
#include "lv/scar/scar_map.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Late enhancement on the page: the enhanced slices, the wall on them, and the scar that a
/// threshold proposes and an observer corrects.
namespace lv::draw {

/// The wall's outlines on each enhanced slice, where it has any.
using Walls = std::vector<std::optional<scar::WallOutlines>>;

/// The scar as it was proposed, and as it stands.
struct ScarDrawing {
  Walls walls;
  scar::ScarMap proposed, drawn;
};

/// The late-enhancement image of a case and the scar on it.
struct Enhancement {
  image::Cine image;
  Greys greys;
  ScarDrawing scar;
  bool saved = false;  ///< the scar comes from the drawing's folder
  std::string note;    ///< why nothing is proposed; empty if it is
};

/// What the threshold is taken from.
enum class ScarRule {
  remote,     ///< scar::above_remote of the pixels that an observer showed
  brightest,  ///< scar::half_of_brightest of the wall
  level       ///< a grey value that an observer chose
};

struct ScarWish {
  ScarRule rule = ScarRule::brightest;
  double deviations = 5.0;  ///< above remote muscle
  double level = 0.0;
  Walls walls;
  std::vector<std::vector<char>> remote;  ///< per slice, of every pixel whether it is remote
};

/// The image of a case whose infarct.source is "lge", with the scar that is kept in a folder, else
/// with the one that the case's threshold proposes in the wall of a phase (from 1) of a cine. None
/// for other cases. Remote segments of a case say nothing here: where they lie on slices the
/// model's wall would tell. Throws InputError where the image or what is kept cannot be read.
[[nodiscard]] std::optional<Enhancement> open_enhancement(
    const case_file::Case& c, const std::filesystem::path& folder, int phase,
    const std::vector<geometry::Contour>& lines);

/// Where the wall within closed lines of the cine lies on the slices of an image, shifted by
/// infarct.shift and, with infarct.lge.in_plane, each moved onto the wall (scar::register_slices).
[[nodiscard]] Walls walls_on(const case_file::Case& c, const image::Cine& image,
                             const std::vector<geometry::Contour>& lines);

/// The scar in the walls: brighter than the threshold, with dark cores if
/// infarct.lge.fill_no_reflow. Throws InputError where the threshold cannot be taken.
[[nodiscard]] scar::ScarMap propose_scar(const case_file::Case& c, const image::Cine& image,
                                         const ScarWish& wish);

// what write_scar writes
inline constexpr const char* scar_file = "scar.csv";
inline constexpr const char* proposed_scar_file = "scar_proposed.csv";
inline constexpr const char* scar_walls_file = "scar_wall.csv";

/// Writes into a folder
///
///   scar.csv           as infarct.lge.drawn reads it
///   scar_proposed.csv  the same of what the threshold proposed
///   scar_wall.csv      the wall's outlines on the enhanced slices, in the form of contours
///
/// Throws RunError when a file cannot be written.
void write_scar(const Enhancement& enhancement, const ScarDrawing& scar,
                const std::filesystem::path& folder);

/// Takes a scar that was written for the image's.
void keep(Enhancement& enhancement, ScarDrawing scar);

}  // namespace lv::draw
