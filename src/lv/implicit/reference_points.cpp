#include "lv/implicit/reference_points.hpp"

#include "lv/mesh/cell.hpp"

#include <Eigen/LU>

#include <algorithm>

namespace lv::implicit {
namespace {

using mesh::CellKind;

Eigen::Matrix3Xd gather(std::span<const Vec3> values, std::span<const int> nodes) {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t a = 0; a < nodes.size(); ++a)
    result.col(static_cast<Eigen::Index>(a)) = values[nodes[a]];
  return result;
}

Eigen::VectorXd gather(std::span<const double> values, std::span<const int> nodes) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t a = 0; a < nodes.size(); ++a)
    result[static_cast<Eigen::Index>(a)] = values[nodes[a]];
  return result;
}

}  // namespace

PointMaker::PointMaker(const mesh::Mesh& mesh, const mesh::FibreRule& fibres)
    : mesh_(mesh),
      fibres_(fibres),
      radial_(mesh.kind == CellKind::tetrahedron ? mesh::radial_directions(mesh)
                                                 : std::vector<Vec3>{}) {}

std::vector<Point> PointMaker::points(const solid::ShapeTable& shapes, int element,
                                      std::span<const int> nodes) const {
  const Eigen::Matrix3Xd X = gather(mesh_.nodes, nodes);
  const Eigen::VectorXd t = gather(mesh_.transmural, nodes);
  const Eigen::VectorXd M = gather(mesh_.infarct, nodes);
  const int cell = element * (mesh_.order == 2 ? 8 : 1);
  std::vector<Point> result;
  for (int q = 0; q < shapes.points(); ++q) {
    const Eigen::Matrix3Xd to_xi = shapes.gradient[q];
    const Eigen::VectorXd phi = shapes.value.row(q);
    const Mat3 dX_dxi = X * to_xi.transpose();
    const double det = dX_dxi.determinant();
    if (!(det > 0.0))
      mesh::fail_inverted(cell, det, X * phi);
    const Eigen::Matrix3Xd gradient = dX_dxi.inverse().transpose() * to_xi;
    const Vec3 radial = radial_.empty() ? Vec3(gradient * t) : Vec3(gather(radial_, nodes) * phi);
    const Mat3 frame = mesh::fibre_frame(
        mesh_, fibres_,
        {cell, nodes, {phi.data(), nodes.size()}, mesh::wall_axes(radial), phi.dot(t)});
    result.push_back(
        {frame.transpose() * gradient, det * shapes.weight[q], std::clamp(phi.dot(M), 0.0, 1.0)});
  }
  return result;
}

}  // namespace lv::implicit
