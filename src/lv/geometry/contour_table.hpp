#pragma once

#include "lv/base/table.hpp"
#include "lv/geometry/contours.hpp"

#include <vector>

namespace lv::geometry {

/// Contours as read_contours and read_curves take them: a row per point with slice, contour (endo
/// or epi), point, x_mm, y_mm, z_mm with so many decimals; and how, by
/// and when, if any of them says how it was drawn.
[[nodiscard]] Table contour_table(const std::vector<Contour>& contours, int decimals = 3);

}  // namespace lv::geometry
