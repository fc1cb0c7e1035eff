#pragma once

#include "lv/image/picture.hpp"

#include <string>

namespace lv::image {

/// "1.370 mm", or "1.370 x 1.400 mm" where columns and rows are not equally far apart.
[[nodiscard]] std::string spacing_text(const Plane& plane);

/// "256 x 208 pixels of 1.370 mm".
[[nodiscard]] std::string grid_text(const Plane& plane);

/// Whether two images have equally many columns and rows, and pixels of one size.
[[nodiscard]] bool same_grid(const Plane& a, const Plane& b);

/// "pixels of 0.14 mm: the header's unit seems wrong" for sizes [mm] that images of hearts do not
/// have; empty for those that they have.
[[nodiscard]] std::string unusual_pixels(double spacing_i, double spacing_j);

/// Throws InputError unless all slices have the grid of the first: for what goes from pixel to
/// pixel through the slices. `where` names the images, `parameter` what chooses their series.
void require_one_grid(const Cine& cine, const std::string& where, const std::string& parameter);

}  // namespace lv::image
