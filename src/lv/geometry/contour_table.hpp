#pragma once

#include "lv/base/table.hpp"
#include "lv/geometry/contours.hpp"

#include <vector>

namespace lv::geometry {

/// Contours as read_contours and read_curves take them: a row per point with slice, contour (endo
/// or epi), point, x_mm, y_mm, z_mm.
[[nodiscard]] Table contour_table(const std::vector<Contour>& contours);

}  // namespace lv::geometry
