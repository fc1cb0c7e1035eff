#include "lv/calibrate/posterior.hpp"

#include "lv/base/dense.hpp"

namespace lv::calibrate {

Posterior posterior(const Eigen::MatrixXd& slopes, Eigen::Index penalties) {
  const auto of_data = slopes.topRows(slopes.rows() - penalties);
  Posterior p{dense::inverse_of_normal_matrix(slopes), {}};
  p.resolution = (p.covariance * (of_data.transpose() * of_data)).diagonal();
  return p;
}

}  // namespace lv::calibrate
