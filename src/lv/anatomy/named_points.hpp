#pragma once

#include "lv/anatomy/drawn.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lv::anatomy {

/// The middle of the septum by the landmarks of a case, image space [mm]; none if the case or its
/// landmarks do not show it. A note is added if the insertions seem to be exchanged. Throws
/// InputError as geometry::septum_of.
[[nodiscard]] std::optional<Vec3> named_septum(const case_file::Case& c,
                                               const geometry::Contours& contours,
                                               std::vector<std::string>& notes);

/// Takes the landmarks of anatomy.contours.landmarks for the contours': the middle of the septum,
/// the tips, and the mitral annulus, in which the base plane then lies unless the case says
/// otherwise. The centre of the blood is not needed here. Throws InputError where a tip is shown by
/// another file too.
void add_landmarks(const case_file::Case& c, Drawn& drawn);

}  // namespace lv::anatomy
