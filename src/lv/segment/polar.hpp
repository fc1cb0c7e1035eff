#pragma once

#include "lv/image/picture.hpp"

#include <Eigen/Core>

#include <numbers>
#include <vector>

namespace lv::segment {

/// A place in a picture: column and row of pixels, whose centres have whole numbers.
using Pixel = Eigen::Vector2d;

/// Values round a centre: a row per ray, a column per radius.
using Polar = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A radius per ray [mm].
using Radii = Eigen::ArrayXd;

/// The angle of one of so many rays, 2 pi i/n, from a picture's columns to its rows.
inline double ray_angle(Eigen::Index ray, Eigen::Index rays) {
  return 2.0 * std::numbers::pi * static_cast<double>(ray) / static_cast<double>(rays);
}

/// The rays and radii of a polar picture: radius k is first + k step.
struct PolarGrid {
  int rays = 72;
  int radii = 79;
  double first = 1.0;  ///< [mm]
  double step = 0.75;  ///< [mm]

  [[nodiscard]] double angle(int ray) const { return ray_angle(ray, rays); }
  [[nodiscard]] double radius(int k) const { return first + k * step; }
  [[nodiscard]] double last() const { return radius(radii - 1); }
  /// The nearest radius of the grid.
  [[nodiscard]] int index(double radius) const;
};

/// The grey value at a place, linear between pixels; beyond the edge that of the edge.
[[nodiscard]] double grey_at(const image::Picture& picture, const Pixel& at);

/// Grey values round a centre, linear between pixels and those of the edge beyond it, smoothed over
/// neighbours (deviations of half a ray and 0.7 radii).
[[nodiscard]] Polar sample(const image::Picture& picture, const Pixel& centre,
                           const PolarGrid& grid);

/// The place in the picture that lies `radius` from the centre along a ray.
[[nodiscard]] Pixel place(const image::Plane& plane, const Pixel& centre, double angle,
                          double radius);

/// The closed line of these radii round a centre in image space [mm].
[[nodiscard]] std::vector<Vec3> line(const image::Plane& plane, const Pixel& centre,
                                     const Radii& radii);

/// The distance of every radius of a grid from a line along its ray [mm], positive outside.
[[nodiscard]] Polar distance_from(const Radii& line, const PolarGrid& grid);

/// The area within, 1/2 sum r_i r_(i+1) sin(2 pi/n) [mm^2].
[[nodiscard]] double area(const Radii& radii);

/// The centroid within, from the centre [mm].
[[nodiscard]] Eigen::Vector2d centroid(const Radii& radii);

}  // namespace lv::segment
