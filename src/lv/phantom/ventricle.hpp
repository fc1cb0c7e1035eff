#pragma once

#include "lv/base/tensor.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/geometry/ellipsoid.hpp"

#include <numbers>

namespace lv::phantom {

/// A scar: a sector of the wall between two heights, from the endocardium outwards. Angles about
/// the long axis from the middle of the septum (x) towards the anterior wall (y).
struct Scar {
  double angle = std::numbers::pi / 6.0;  ///< of the sector's middle [rad]; 30 deg: antero-septal
  double width = std::numbers::pi / 2.0;  ///< of the sector [rad]
  double bottom = -65.0, top = -25.0;     ///< heights at end-diastole [mm]
  double transmurality = 0.6;             ///< part of the wall's thickness; 0: no scar
};

/// What the phantom's ventricle is at end-diastole and how it moves.
struct Ventricle {
  geometry::Ellipsoid shape{
      .endo_radius = 26.0, .endo_length = 68.0, .epi_radius = 35.0, .epi_length = 76.0};
  double squeeze = 0.6;      ///< part of the cavity that healthy muscle would eject
  double shortening = 0.04;  ///< of the long axis, by descent of the base; the apex stays
  double rotation_base =
      -4.0 * std::numbers::pi / 180.0;  ///< anticlockwise seen from the apex [rad]
  double rotation_apex = 12.0 * std::numbers::pi / 180.0;  ///< at the epicardial apex; linear in Z
  Scar scar;
  double akinesia = 0.8;    ///< how much of the squeeze is lost in the middle of the scar
  double papillary = 0.0;   ///< radius of two papillary muscles, see in_papillary [mm]; 0: none
  double trabeculae = 0.0;  ///< depth of a rim, see Trabeculae [mm]; 0: none

  [[nodiscard]] double apex() const { return -shape.base_height - shape.epi_length; }
  [[nodiscard]] double cavity_apex() const { return -shape.base_height - shape.endo_length; }
  /// Squared radius of a surface at a height, at end-diastole [mm^2]; negative beyond its apex.
  [[nodiscard]] double radius_squared(geometry::Side side, double Z) const;
  [[nodiscard]] bool in_scar(const Vec3& X) const;
};

/// How far the ventricle has contracted at a time in the cycle, 0 (end-diastole) to 1
/// (end-systole): systole, early filling, rest, and the atrium's kick, each a half wave of a
/// cosine. `time` as a fraction of the cycle.
[[nodiscard]] double contraction(double time);

inline constexpr double end_systole = 0.36;  ///< time at which contraction is 1

/// The motion from end-diastole to a degree of contraction s, in cylinder coordinates of the model
/// frame:
///
///   z     = l Z + (l - 1)(-Z_apex),         l = 1 - s shortening
///   r^2   = (R^2 - c(Theta, Z)) / l,        c = s squeeze w(Theta, Z) R_endo(Z)^2
///   theta = Theta - s rotation(Z)
///
/// It keeps every volume, det F = 1, for any c; its inverse is explicit; planes Z = const stay
/// planes. w is 1 in healthy muscle and 1 - akinesia in the middle of the scar. The cavity holds
///
///   V(s) = 1/2 int int (R_endo^2 - c) dTheta dZ,
///
/// which without scar is (1 - s squeeze) V(0).
class Motion {
 public:
  Motion(const Ventricle& ventricle, double s);

  /// Where a point of the wall at end-diastole is now.
  [[nodiscard]] Vec3 forward(const Vec3& X) const;
  /// The point at end-diastole of what is now at x. Its radius is 0 where r is less than the motion
  /// leaves open (in the cavity alone).
  [[nodiscard]] Vec3 inverse(const Vec3& x) const;
  /// dx/dX.
  [[nodiscard]] Mat3 gradient(const Vec3& X) const;

  [[nodiscard]] double z(double Z) const { return stretch_ * Z + (1.0 - stretch_) * apex_; }
  [[nodiscard]] double Z(double z) const { return (z - (1.0 - stretch_) * apex_) / stretch_; }
  /// Radius of a surface now, at height z and angle theta [mm]; 0 beyond its apex.
  [[nodiscard]] double radius(geometry::Side side, double z, double theta) const;
  [[nodiscard]] double cavity_volume() const;

 private:
  /// c and its derivatives by Theta and Z.
  struct Squeeze {
    double value, by_theta, by_Z;
  };
  [[nodiscard]] Squeeze squeeze(double Theta, double Z) const;
  [[nodiscard]] double rotation(double Z) const;

  const Ventricle& v_;
  double s_, stretch_, apex_;
};

/// Volume of the wall, the same at all times [mm^3].
[[nodiscard]] double wall_volume(const Ventricle& ventricle);

/// Volume of the scar: 1/2 width int (R_scar^2 - R_endo^2) dZ [mm^3].
[[nodiscard]] double scar_volume(const Ventricle& ventricle);

}  // namespace lv::phantom
