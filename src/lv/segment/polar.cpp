#include "lv/segment/polar.hpp"

#include <algorithm>
#include <cmath>

namespace lv::segment {
namespace {

/// Three taps with the variance 1/2 along the radii and 1/4 across.
Polar smoothed(const Polar& values) {
  const auto rays = values.rows();
  const auto last = values.cols() - 1;
  Polar along = values;
  along.middleCols(1, last - 1) = 0.5 * values.middleCols(1, last - 1) +
                                  0.25 * (values.leftCols(last - 1) + values.rightCols(last - 1));
  Polar result = along;
  for (Eigen::Index i = 0; i < rays; ++i)
    result.row(i) = 0.75 * along.row(i) +
                    0.125 * (along.row((i + 1) % rays) + along.row((i + rays - 1) % rays));
  return result;
}

}  // namespace

double grey_at(const image::Picture& picture, const Pixel& at) {
  const image::Plane& plane = picture.plane;
  const double x = std::clamp(at.x(), 0.0, plane.columns - 1.0);
  const double y = std::clamp(at.y(), 0.0, plane.rows - 1.0);
  const int i = std::min(static_cast<int>(x), std::max(plane.columns - 2, 0));
  const int j = std::min(static_cast<int>(y), std::max(plane.rows - 2, 0));
  const int right = std::min(i + 1, plane.columns - 1);
  const int below = std::min(j + 1, plane.rows - 1);
  const double u = x - i;
  const double v = y - j;
  return (1.0 - v) * ((1.0 - u) * picture.at(i, j) + u * picture.at(right, j)) +
         v * ((1.0 - u) * picture.at(i, below) + u * picture.at(right, below));
}

int PolarGrid::index(double radius) const {
  return std::clamp(static_cast<int>(std::lround((radius - first) / step)), 0, radii - 1);
}

Pixel place(const image::Plane& plane, const Pixel& centre, double angle, double radius) {
  return centre + Pixel(radius * std::cos(angle) / plane.spacing_i,
                        radius * std::sin(angle) / plane.spacing_j);
}

Polar sample(const image::Picture& picture, const Pixel& centre, const PolarGrid& grid) {
  Polar values(grid.rays, grid.radii);
  for (int i = 0; i < grid.rays; ++i)
    for (int k = 0; k < grid.radii; ++k)
      values(i, k) = grey_at(picture, place(picture.plane, centre, grid.angle(i), grid.radius(k)));
  return smoothed(values);
}

std::vector<Vec3> line(const image::Plane& plane, const Pixel& centre, const Radii& radii) {
  std::vector<Vec3> points;
  for (Eigen::Index i = 0; i < radii.size(); ++i) {
    const double angle = ray_angle(i, radii.size());
    const Pixel at = place(plane, centre, angle, radii(i));
    points.push_back(plane.point(at.x(), at.y()));
  }
  return points;
}

Polar distance_from(const Radii& line, const PolarGrid& grid) {
  const Eigen::ArrayXd radii = Eigen::ArrayXd::LinSpaced(grid.radii, grid.first, grid.last());
  return radii.transpose().replicate(grid.rays, 1) - line.replicate(1, grid.radii);
}

double area(const Radii& radii) {
  const auto n = radii.size();
  double sum = radii(n - 1) * radii(0);
  for (Eigen::Index i = 1; i < n; ++i)
    sum += radii(i - 1) * radii(i);
  return 0.5 * sum * std::sin(ray_angle(1, n));
}

Eigen::Vector2d centroid(const Radii& radii) {
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (Eigen::Index i = 0; i < radii.size(); ++i) {
    const double angle = ray_angle(i, radii.size());
    moment += std::pow(radii(i), 3) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return 2.0 / 3.0 * moment / radii.square().sum();
}

}  // namespace lv::segment
