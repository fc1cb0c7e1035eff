#pragma once

#include <Eigen/Core>

#include <functional>

namespace lv::calibrate {

/// Where |r(x)|^2 is smallest.
struct Minimum {
  Eigen::VectorXd x, r;
  int evaluations = 0;  ///< of r
};

/// Levenberg-Marquardt within bounds, with forward differences. `residuals` may throw RunError:
/// such a step is shortened. Throws RunError when it does not come to an end.
///
/// `difference` is the step of the derivatives and `longest` the first trust region, in units of x.
[[nodiscard]] Minimum least_squares(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& residuals,
    const Eigen::VectorXd& start, const Eigen::VectorXd& low, const Eigen::VectorXd& high,
    double difference, double longest);

}  // namespace lv::calibrate
