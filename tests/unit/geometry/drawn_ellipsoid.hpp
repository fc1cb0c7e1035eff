#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/geometry/ellipsoid.hpp"
#include "lv/geometry/frame.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>

namespace drawn {

using lv::Mat3;
using lv::Vec3;
using lv::geometry::Contour;
using lv::geometry::Contours;
using lv::geometry::Ellipsoid;
using lv::geometry::Frame;
using lv::geometry::Side;
using std::numbers::pi;

/// A frame that is aligned with nothing, as a scanner's slices are.
inline Frame oblique_frame() {
  Frame frame;
  frame.axes = (Eigen::AngleAxisd(2.1, Vec3(0.3, -0.8, 0.5).normalized())).toRotationMatrix();
  frame.origin = {51.0, -37.5, 122.0};
  return frame;
}

/// How an observer draws the contours of an ellipsoidal ventricle.
struct Drawing {
  Ellipsoid shape;
  Frame frame;  ///< of the ventricle in the scanner
  int slices = 8;
  double spacing = 10.0;  ///< [mm], the first slice at the base
  double tilt = 0.0;      ///< of the slices against the axis [radians]
  int points = 40;
  bool long_axis = true;  ///< three curves of either side
  bool apex = true;
  double noise = 0.0;  ///< standard deviation across each line [mm]
  unsigned seed = 1;
};

/// Drawn askew in the scanner.
inline Drawing in_scanner() {
  Drawing drawing;
  drawing.frame = oblique_frame();
  return drawing;
}

inline double semi_axis_across(const Ellipsoid& e, Side side) {
  return side == Side::endo ? e.endo_radius : e.epi_radius;
}

inline double semi_axis_along(const Ellipsoid& e, Side side) {
  return side == Side::endo ? e.endo_length : e.epi_length;
}

/// Distance from the ellipsoid of one side, to first order, positive outside [mm].
inline double distance(const Ellipsoid& e, Side side, const Vec3& x) {
  const double a = semi_axis_across(e, side);
  const double c = semi_axis_along(e, side);
  const Vec3 scaled(x.x() / a, x.y() / a, (x.z() + e.base_height) / c);
  const Vec3 gradient = Vec3(scaled.x() / a, scaled.y() / a, scaled.z() / c) / scaled.norm();
  return (scaled.norm() - 1.0) / gradient.norm();
}

/// Where the ray from `from` (inside) in the direction `ray` leaves the ellipsoid.
inline Vec3 exit_point(const Ellipsoid& e, Side side, const Vec3& from, const Vec3& ray) {
  const Vec3 scale(1.0 / semi_axis_across(e, side), 1.0 / semi_axis_across(e, side),
                   1.0 / semi_axis_along(e, side));
  const Vec3 p = scale.cwiseProduct(from + Vec3(0.0, 0.0, e.base_height));
  const Vec3 d = scale.cwiseProduct(ray);
  const double a = d.squaredNorm();
  const double b = p.dot(d);
  const double c = p.squaredNorm() - 1.0;
  return from + (-b + std::sqrt(b * b - a * c)) / a * ray;
}

class Pen {
 public:
  explicit Pen(const Drawing& drawing) : d_(drawing), random_(drawing.seed) {}

  Contours draw() {
    Contours contours;
    const Mat3 tilted = Eigen::AngleAxisd(d_.tilt, Vec3::UnitX()).toRotationMatrix();
    for (int k = 0; k < d_.slices; ++k)
      for (const Side side : {Side::endo, Side::epi})
        contours.short_axis.push_back(loop(k, side, tilted));
    for (int k = 0; k < 3 && d_.long_axis; ++k)
      for (const Side side : {Side::endo, Side::epi})
        contours.long_axis.push_back(curve(k, side));
    for (const Side side : {Side::endo, Side::epi})
      if (d_.apex)
        contours.apex.push_back(line(1, side, {d_.shape.point(0.0, 0.0, depth(side))}));
    return contours;
  }

 private:
  static double depth(Side side) { return side == Side::endo ? 0.0 : 1.0; }

  [[nodiscard]] Contour line(int slice, Side side, std::vector<Vec3> points) const {
    for (Vec3& x : points)
      x = d_.frame.to_image(x);
    return {slice, side, std::move(points), "drawing.csv", {}};
  }

  Contour loop(int k, Side side, const Mat3& tilted) {
    const Vec3 centre(0.0, 0.0, -k * d_.spacing);
    std::vector<Vec3> points;
    for (int i = 0; i < d_.points; ++i) {
      const double angle = 2.0 * pi * i / d_.points;
      const Vec3 ray = tilted * Vec3(std::cos(angle), std::sin(angle), 0.0);
      points.emplace_back(exit_point(d_.shape, side, centre, ray) + wobble() * ray);
    }
    return line(k + 1, side, std::move(points));
  }

  /// From a little above the base on one side over the apex to the other side.
  Contour curve(int k, Side side) {
    constexpr int half = 14;
    std::vector<Vec3> points;
    const double theta = 0.2 + pi * k / 3.0;
    for (int i = -half; i <= half; ++i) {
      const Vec3 x =
          d_.shape.point(1.04 * std::abs(i) / half, i < 0 ? theta : theta + pi, depth(side));
      const Vec3 centre(0.0, 0.0, -d_.shape.base_height);
      points.emplace_back(x + wobble() * (x - centre).normalized());
    }
    return line(k + 1, side, std::move(points));
  }

  double wobble() { return d_.noise * normal_(random_); }

  Drawing d_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

inline Contours draw(const Drawing& drawing) {
  return Pen(drawing).draw();
}

/// Moves each slice by `length` in its plane in a random direction; returns the moves.
inline std::vector<Vec3> shift_slices(Contours& contours, const Frame& frame, double length,
                                      unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angles(0.0, 2.0 * pi);
  std::vector<Vec3> shifts;
  for (std::size_t i = 0; i < contours.short_axis.size(); i += 2) {
    const double angle = angles(random);
    shifts.emplace_back(frame.axes * Vec3(length * std::cos(angle), length * std::sin(angle), 0.0));
    for (Contour* c : {&contours.short_axis[i], &contours.short_axis[i + 1]})
      for (Vec3& x : c->points)
        x += shifts.back();
  }
  return shifts;
}

}  // namespace drawn
