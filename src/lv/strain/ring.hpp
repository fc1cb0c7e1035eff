#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

/// Strain and rotation of short-axis slices in their plane.
///
/// Slice frame: origin in the middle of the cavity at end-diastole, x towards the septum, y towards
/// the anterior wall, as seen from the base [mm].
namespace lv::strain {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

/// Where a point of the slice has gone, and dx/dX there.
struct Moved {
  Vec2 x;
  Mat2 F;
};

/// A motion of the slice in its plane from end-diastole, in its frame.
using Deformation = std::function<Moved(const Vec2&)>;

/// The distance of a surface from the origin as a function of the angle from x towards y [mm].
using RadiusAt = std::function<double(double angle)>;

/// The wall of a slice at end-diastole.
struct SliceWall {
  RadiusAt endo, epi;
};

/// What one ray from the middle of the cavity through the wall comes to.
struct Ray {
  double angle = 0.0;  ///< at end-diastole [rad]
  double area = 0.0;   ///< of the wall between the rays' bisectors at end-diastole [mm^2]
  /// Components of E = (F^T F - 1)/2 around and outwards, means over the ray by area.
  double circumferential = 0.0, radial = 0.0;
  double line_then = 0.0, line_now = 0.0;  ///< of the mid-wall line that belongs to the ray [mm]
  double thickness_then = 0.0, thickness_now = 0.0;  ///< from endocardium to epicardium [mm]
};

/// A slice at one time.
struct SliceMotion {
  std::vector<Ray> rays;  ///< evenly about the cavity
  double rotation = 0.0;  ///< [rad], anticlockwise seen from the apex positive
};

/// Strains of a part of a slice, or of several.
struct RingStrain {
  double circumferential = 0.0;  ///< Green-Lagrange, mean over the wall's area
  double radial = 0.0;           ///< Green-Lagrange, mean over the wall's area
  double shortening = 0.0;       ///< of the mid-wall line: length / length at end-diastole - 1
  double thickening = 0.0;       ///< thickness / thickness at end-diastole - 1
};

/// Follows the wall of a slice. The rotation is that of the rigid motion that fits best to the wall
/// by area, as analysis::rotation has it for the model.
[[nodiscard]] SliceMotion follow(const SliceWall& wall, const Deformation& motion);

/// Strain of the given rays, of one slice or several. NaN without rays.
[[nodiscard]] RingStrain strain_of(const std::vector<Ray>& rays);

}  // namespace lv::strain
