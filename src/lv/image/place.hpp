#pragma once

#include "lv/image/volume.hpp"

#include <string>

namespace lv::image {

/// A map of voxels (i, j, k, 1) to a place [mm], or in a file's own unit.
using Affine = Eigen::Matrix<double, 3, 4>;

/// Lays a volume, whose file and size are known, by a map of its voxels to image space (LPS) [mm].
/// Axes less than 0.1 degrees off right angles, by rounding, become orthonormal. `called` is what
/// the map is called in the file and `unit` the file's unit of length, for messages. Throws
/// InputError for a map that is sheared or flat, and for sizes and places that no scanner has.
void lay(const Affine& map, const std::string& called, const std::string& unit, Volume& volume);

}  // namespace lv::image
