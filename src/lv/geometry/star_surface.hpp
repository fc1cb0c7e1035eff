#pragma once

#include "lv/base/tensor.hpp"
#include "lv/geometry/bspline.hpp"

#include <optional>
#include <utility>

namespace lv::geometry {

/// A spheroid about the long axis.
struct Spheroid {
  double a = 1.0;   ///< semi-axis across [mm]
  double c = 1.0;   ///< semi-axis along [mm]
  double z0 = 0.0;  ///< height of the centre [mm]
};

/// Polar coordinates in the space where the spheroid is the unit sphere:
///
///   (x/a, y/a, (z - z0)/c) = s (sin mu cos theta, sin mu sin theta, -cos mu)
struct Polar {
  double s, mu, theta;
};
[[nodiscard]] Polar polar(const Spheroid& spheroid, const Vec3& x);
[[nodiscard]] Vec3 cartesian(const Spheroid& spheroid, const Polar& p);

/// A smooth surface in the model frame that every ray from the spheroid's centre meets once,
///
///   s = s(mu, theta) = sum_kj c_kj N_k(mu) M_j(theta),
///
/// a tensor product of cubic B-splines: clamped in mu from the apex (mu = 0) to above the base,
/// periodic in theta. s = 1 is the spheroid.
class StarSurface {
 public:
  /// `coefficients`: c_kj, one row per function of mu.
  StarSurface(const Spheroid& spheroid, CubicBasis along, CubicBasis around,
              Eigen::MatrixXd coefficients);

  [[nodiscard]] const Spheroid& spheroid() const { return spheroid_; }

  /// s with its derivatives.
  struct Scale {
    double s, s_mu, s_theta;
  };
  [[nodiscard]] Scale scale(double mu, double theta) const;
  [[nodiscard]] Vec3 point(double mu, double theta) const;

  /// F(x) = s of x minus s of the surface on the ray through x, which is negative inside, and its
  /// gradient [1/mm]. F/|gradient| is the distance to first order.
  struct Level {
    double value;
    Vec3 gradient;
  };
  [[nodiscard]] Level level(const Vec3& x) const;
  [[nodiscard]] Vec3 normal(double mu, double theta) const;  ///< outward

  /// The nearest point of the surface, for x nearer than its radii of curvature.
  [[nodiscard]] Vec3 closest(const Vec3& x) const;

  /// Distance to the surface, negative inside [mm].
  [[nodiscard]] double distance(const Vec3& x) const;

  /// Whether s > 0 and every meridian reaches up to z = 0; what follows needs that.
  [[nodiscard]] bool is_sound() const;

  /// The first mu from the apex at which the meridian `theta` meets the plane z = 0.
  [[nodiscard]] double base_angle(double theta) const;

  /// Enclosed below z = 0 [mm^3].
  [[nodiscard]] double enclosed_volume() const;

 private:
  [[nodiscard]] double height(double mu, double theta) const;
  [[nodiscard]] std::optional<std::pair<double, double>> base_bracket(double theta) const;

  Spheroid spheroid_;
  CubicBasis along_, around_;
  Eigen::MatrixXd coefficients_;
};

}  // namespace lv::geometry
