#pragma once

#include "lv/draw/study.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace lv::draw {

/// What the page needs of the late enhancement besides its pictures: null without one. Outlines are
/// in mm along rows and columns from the first pixel, pixels are runs [row, first, last] from 0.
[[nodiscard]] nlohmann::json enhancement_json(const Study& study);

/// The lines of a phase of the cine, {"contours": [...]}, between which the wall lies. Throws
/// InputError for what no page of ours would send, as do the others.
[[nodiscard]] std::vector<geometry::Contour> read_wall_lines(const std::string& text,
                                                             const Study& study);

/// {"walls": [{"endo": [[x, y], ...], "epi": [...]} or null, ...]}
[[nodiscard]] std::string walls_text(const Walls& walls);

/// {"rule": "remote", "brightest" or "level", "deviations": 5, "level": 120, "walls": [...],
/// "remote": [[[row, first, last], ...], ...]}
[[nodiscard]] ScarWish read_scar_wish(const std::string& text, const Study& study);

/// {"threshold": 120, "slices": [{"muscle": runs, "remote": runs, "scar": runs, "how": "proposed",
/// "by": "", "when": ""}, ...]}
[[nodiscard]] std::string scar_map_text(const scar::ScarMap& map, const image::Cine& image);

/// What a page wants to be kept of the scar.
[[nodiscard]] ScarDrawing said_scar(const nlohmann::json& object, const Study& study);

}  // namespace lv::draw
