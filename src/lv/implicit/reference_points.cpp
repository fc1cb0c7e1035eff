#include "lv/implicit/reference_points.hpp"

#include <Eigen/LU>

namespace lv::implicit {

std::vector<Point> PointMaker::points(const solid::ShapeTable& shapes, int cell,
                                      std::span<const int> nodes) const {
  std::vector<Point> result;
  for (int q = 0; q < shapes.points(); ++q) {
    const Eigen::MatrixXd& to_xi = shapes.gradient[q];
    const Eigen::VectorXd phi = shapes.value.row(q);
    const mesh::UndeformedPoint X =
        undeformed_.at({cell, nodes, {phi.data(), nodes.size()}, {to_xi.data(), 3 * nodes.size()}});
    result.push_back({X.frame.transpose() * (X.dX_dxi.inverse().transpose() * to_xi),
                      X.det * shapes.weight[q], X.M});
  }
  return result;
}

}  // namespace lv::implicit
