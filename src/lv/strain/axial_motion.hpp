#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/geometry/frame.hpp"
#include "lv/image/picture.hpp"
#include "lv/strain/warp.hpp"

#include <Eigen/Core>

#include <vector>

namespace lv::strain {

/// A long-axis image to be followed: its cine and the wall drawn on one of its images.
struct LongAxisTask {
  const image::CineSlice* cine = nullptr;
  int drawn = 0;                ///< index of the image with the curves
  geometry::Contour endo, epi;  ///< from the base over the apex to the base
};

/// How far the wall has moved along the long axis since end-diastole, as long-axis images show it.
///
/// In a frame with its origin at the apex and z towards the base, of a point (X, Y, Z) of the wall
/// at end-diastole,
///
///   u(X, Y, Z; t) = a + b Z + (c X + d Y) Z
///
/// at every time: the wall shortens evenly along its axis, and its base may tilt. The coefficients
/// are those of least squares, the smallest ones if there is only one view, over points of the wall
/// that Tracker follows. So few, because single points of the wall's middle are followed to some
/// 2 mm only: there is no edge across the axis, and torsion carries muscle out of the image.
class AxialMotion {
 public:
  /// Follows the views. `images` is in how many steps the cycle is to be known: views that have
  /// another number of images are interpolated, all being evenly spread over the cycle. Throws
  /// InputError for curves that lie outside their images.
  AxialMotion(const std::vector<LongAxisTask>& views, const geometry::Frame& frame, int images,
              const RegistrationParameters& parameters);

  /// u at a step of the cycle after end-diastole [mm].
  [[nodiscard]] double operator()(const Vec3& X, int step) const;

  /// Root mean square of what u leaves of the motion seen, over the wall, at a step [mm].
  [[nodiscard]] double residual(int step) const { return residuals_.at(step); }

 private:
  geometry::Frame frame_;
  Eigen::MatrixXd coefficients_;  ///< a column per step
  std::vector<double> residuals_;
};

}  // namespace lv::strain
