#pragma once

#include "lv/base/outcome.hpp"

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace lv::calibrate {

/// Where |r(x)|^2 is smallest.
struct Minimum {
  Eigen::VectorXd x, r;
  int evaluations = 0;          ///< of r
  Eigen::MatrixXd slopes = {};  ///< dr/dx there, as it was learnt; of broyden_least_squares alone
};

/// r(x); there may be places without.
using Residuals = std::function<Outcome<Eigen::VectorXd>(const Eigen::VectorXd&)>;

/// Levenberg-Marquardt within bounds, with forward differences. A step to where there are no
/// residuals is shortened. Throws NoSolution when it does not come to an end, or has none to start
/// from.
///
/// `difference` is the step of the derivatives and `longest` the first trust region, in units of x.
[[nodiscard]] Minimum least_squares(const Residuals& residuals, const Eigen::VectorXd& start,
                                    const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                                    double difference, double longest);

/// How such a search goes. Lengths are in units of x.
struct CostlySearch {
  double difference = 0.0;                     ///< of the derivatives
  double longest = 0.0;                        ///< step, of each component
  double shortest = 0.0;                       ///< step, with which the search ends
  std::optional<Eigen::MatrixXd> slopes = {};  ///< dr/dx from near by save the first differences
  /// Told how many evaluations are still to come, as it looks; may be empty.
  std::function<void(double)> expect = {};
};

/// The same for residuals that cost much: Gauss-Newton steps with one set of forward differences
/// and Broyden's updates after it (C. G. Broyden, Math. Comput. 19:577, 1965). A step that comes no
/// nearer is shortened; where that does not help the differences are taken anew, once. Unsolved
/// without residuals at the start.
Outcome<Minimum> broyden_least_squares(const Residuals& residuals, const Eigen::VectorXd& start,
                                       const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                                       const CostlySearch& search);

}  // namespace lv::calibrate
