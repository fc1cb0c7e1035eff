#pragma once

#include "lv/base/outcome.hpp"

#include <Eigen/Core>

#include <functional>

namespace lv::calibrate {

/// Where |r(x)|^2 is smallest.
struct Minimum {
  Eigen::VectorXd x, r;
  int evaluations = 0;  ///< of r
};

/// r(x); there may be places without.
using Residuals = std::function<Outcome<Eigen::VectorXd>(const Eigen::VectorXd&)>;

/// Levenberg-Marquardt within bounds, with forward differences. A step to where there are no
/// residuals is shortened. Throws RunError when it does not come to an end, or has none to start
/// from.
///
/// `difference` is the step of the derivatives and `longest` the first trust region, in units of x.
[[nodiscard]] Minimum least_squares(const Residuals& residuals, const Eigen::VectorXd& start,
                                    const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                                    double difference, double longest);

}  // namespace lv::calibrate
