#pragma once

#include "lv/base/tensor.hpp"

namespace lv::geometry {

/// A left ventricle between two truncated ellipsoids of revolution that share centre and axis.
///
/// Model frame: base plane z = 0, centre at z = -base_height, apex at negative z [mm]. At depth t
/// in the wall the semi-axes are linear in t between the endocardium's and the epicardium's. The
/// defaults are the idealised healthy ventricle at early diastole: cavity 70.79 ml, wall 114.24 ml.
struct Ellipsoid {
  double endo_radius = 19.5;  ///< semi-axis across [mm]
  double endo_length = 60.0;  ///< semi-axis along [mm]
  double epi_radius = 30.0;
  double epi_length = 69.0;
  double base_height = 20.0;  ///< of the base plane above the widest section [mm]

  /// The point at fraction u of the polar angle from the apex (0) to the base plane (1), angle
  /// theta about the axis (anticlockwise seen from the base) and depth t (0 endocardium, 1
  /// epicardium).
  [[nodiscard]] Vec3 point(double u, double theta, double t) const;

  /// Volume below the base plane inside the ellipsoid of depth t [mm^3].
  [[nodiscard]] double enclosed_volume(double t) const;
};

}  // namespace lv::geometry
