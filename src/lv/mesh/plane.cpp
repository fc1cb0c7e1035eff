#include "lv/mesh/plane.hpp"

#include <Eigen/Eigenvalues>

namespace lv::mesh {

Plane fit_plane(std::span<const Vec3> points) {
  Plane plane;
  for (const Vec3& x : points)
    plane.point += x / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& x : points)
    spread += (x - plane.point) * (x - plane.point).transpose();
  plane.normal = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().col(0);
  return plane;
}

}  // namespace lv::mesh
