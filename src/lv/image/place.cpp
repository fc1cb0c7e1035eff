#include "lv/image/place.hpp"

#include "lv/base/check.hpp"

#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::image {
namespace {

/// Refuses axes that are not at right angles; makes those that nearly are orthonormal.
void straighten(const std::string& called, Volume& volume) {
  constexpr double right_angle_error = 0.1;  // [degrees]
  for (int d = 0; d < 3; ++d) {
    if (!(volume.spacing[d] > 0.0))
      throw InputError(volume.file, fmt::format("its axis {} has the length 0", "ijk"[d]),
                       fmt::format("Correct the {} or the sizes of voxels in the header", called));
    const int e = (d + 1) % 3;
    const double cosine = volume.directions.col(d).dot(volume.directions.col(e));
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
    if (!(std::abs(angle - 90.0) < right_angle_error))
      throw InputError(volume.file,
                       fmt::format("its {} is sheared: its axes are not at right angles, {} and {} "
                                   "are {:.2f} degrees apart",
                                   called, "ijk"[d], "ijk"[e], angle),
                       "Resample the image to a rectangular grid");
  }
  const Eigen::JacobiSVD<Mat3> svd(volume.directions, Eigen::ComputeFullU | Eigen::ComputeFullV);
  volume.directions = svd.matrixU() * svd.matrixV().transpose();
}

/// Refuses voxels that are no part of a person, before anything is resampled to their size.
void check_sizes(const Volume& volume, const std::string& unit) {
  constexpr double farthest_origin = 1e6;  // of an image from the scanner's centre [mm]
  if (!(volume.spacing.minCoeff() >= smallest_pixel && volume.spacing.maxCoeff() <= largest_pixel))
    throw InputError(volume.file,
                     fmt::format("its voxels measure {:g} x {:g} x {:g} mm (unit of the file: {})",
                                 volume.spacing.x(), volume.spacing.y(), volume.spacing.z(), unit),
                     "Correct the unit or the sizes in the header");
  if (!(volume.origin.cwiseAbs().maxCoeff() <= farthest_origin))
    throw InputError(volume.file,
                     fmt::format("its first voxel lies at ({:.4g}, {:.4g}, {:.4g}) mm",
                                 volume.origin.x(), volume.origin.y(), volume.origin.z()),
                     "Correct the place in the header");
}

}  // namespace

void lay(const Affine& map, const std::string& called, const std::string& unit, Volume& volume) {
  volume.origin = map.col(3);
  for (int d = 0; d < 3; ++d) {
    volume.spacing[d] = map.col(d).norm();
    volume.directions.col(d) = map.col(d).normalized();
  }
  straighten(called, volume);
  check_sizes(volume, unit);
}

}  // namespace lv::image
