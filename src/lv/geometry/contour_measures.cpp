#include "lv/geometry/contour_measures.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

namespace lv::geometry {

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : points)
    sum += x;
  return sum / static_cast<double>(points.size());
}

Frame plane_of(std::span<const Vec3> points) {
  Frame plane;
  plane.origin = mean_of(points);
  Mat3 scatter = Mat3::Zero();
  for (const Vec3& x : points)
    scatter += (x - plane.origin) * (x - plane.origin).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(scatter);  // ascending eigenvalues
  plane.axes.col(2) = solver.eigenvectors().col(0);
  plane.axes.col(0) = solver.eigenvectors().col(2);
  plane.axes.col(1) = plane.axes.col(2).cross(plane.axes.col(0));
  return plane;
}

double mean_radius(const Contour& loop) {
  const Vec3 centre = mean_of(loop.points);
  double sum = 0.0;
  for (const Vec3& x : loop.points)
    sum += (x - centre).norm();
  return sum / static_cast<double>(loop.points.size());
}

double enclosed_area(const Contour& loop) {
  Vec3 twice = Vec3::Zero();
  const Vec3 centre = mean_of(loop.points);
  for (std::size_t i = 0; i < loop.points.size(); ++i)
    twice += (loop.points[i] - centre).cross(loop.points[(i + 1) % loop.points.size()] - centre);
  return 0.5 * twice.norm();
}

std::vector<double> point_lengths(const Contour& contour, bool closed) {
  const std::size_t n = contour.points.size();
  std::vector<double> lengths(n, 0.0);
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const double half = 0.5 * (contour.points[next] - contour.points[i]).norm();
    lengths[i] += half;
    lengths[next] += half;
  }
  return lengths;
}

std::string label(const Contour& contour) {
  return fmt::format("slice {}, {}", contour.slice, name(contour.side));
}

}  // namespace lv::geometry
