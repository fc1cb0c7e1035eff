#pragma once

#include "lv/draw/study.hpp"
#include "lv/segment/redraw.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lv::draw {

/// What the page needs of a study besides its pictures, as JSON. No name of a person, file or
/// folder but the case's and the drawing's: headers of images are not shown.
[[nodiscard]] std::string study_json(const Study& study);

/// A proposal as the page takes it.
[[nodiscard]] std::string proposal_json(const Proposal& proposal);

/// What a page wants to be kept.
struct Kept {
  int revision = 0;  ///< of the study that the page started from
  Drawing drawing;
  std::optional<ScarDrawing> scar;  ///< where the page has changed it, or it was kept before
};

/// Reads and checks it: slices and phases of this study, lines in their planes, of three to 2000
/// points. Throws InputError.
[[nodiscard]] Kept read_kept(const std::string& text, const Study& study);

/// The point {"centre": [x, y, z]} [mm]. Throws InputError.
[[nodiscard]] Vec3 read_centre(const std::string& text);

/// A border that a page wants drawn again: {"slice": 3, "phase": 1, "side": "endo", "points":
/// [...], "endo": [...], "epi": [...]}, lines that are not there empty.
struct Redrawn {
  std::size_t slice = 0;  ///< from 0
  segment::BorderWish wish;
};

/// Reads and checks it: one to 100 points, lines as read_kept takes them. Throws InputError.
[[nodiscard]] Redrawn read_wish(const std::string& text, const Study& study);

/// {"points": [...]}
[[nodiscard]] std::string points_json(const std::vector<Vec3>& points);

/// The pictures of a slice or a long-axis image (Study::picture), a byte per pixel, phase by phase,
/// row by row: 0 and 255 stand for the darkest and brightest thousandth of the short axis, or of
/// that long axis.
[[nodiscard]] std::string picture_bytes(const Study& study, int number);

}  // namespace lv::draw
