#pragma once

#include <Eigen/Core>

namespace lv::calibrate {

/// What least squares whose last residuals are a penalty (x_i - x_0i)/spread leave of the unknowns.
/// With the slopes J of all residuals and J_d of those of data, each over its standard deviation:
///
///   covariance C = (J^T J)^-1,  resolution R = C J_d^T J_d.
///
/// R_ii is the share of x_i that the data determine, from 0 (the penalty alone does) to 1; the
/// trace counts how many unknowns the data determine (A. Tarantola, Inverse Problem Theory, SIAM
/// 2005, section 3.3).
struct Posterior {
  Eigen::MatrixXd covariance;
  Eigen::VectorXd resolution;  ///< R_ii
};
[[nodiscard]] Posterior posterior(const Eigen::MatrixXd& slopes, Eigen::Index penalties);

}  // namespace lv::calibrate
