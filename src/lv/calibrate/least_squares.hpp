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
  bool is_found = false;        ///< whether it ended before there were too many evaluations
  Eigen::MatrixXd slopes = {};  ///< dr/dx there, as it was learnt
};

/// r(x); there may be places without.
using Residuals = std::function<Outcome<Eigen::VectorXd>(const Eigen::VectorXd&)>;

/// How the search goes. Lengths are in units of x.
struct LeastSquaresSearch {
  double difference = 0.0;                     ///< of the derivatives
  double longest = 0.0;                        ///< step, of each component
  double shortest = 0.0;                       ///< step, with which the search ends
  std::optional<Eigen::MatrixXd> slopes = {};  ///< dr/dx from near by save the first differences
  /// Told how many evaluations are still to come, as it looks; may be empty.
  std::function<void(double)> expect = {};
  /// Decrease of |r|^2 that a whole step promises, with which it ends too: where residuals are in
  /// units of their errors, such a step is sqrt(negligible) standard errors long at most.
  double negligible = 0.0;
  /// Whether the last step is one by fresh differences: the minimum of residuals that stay large
  /// is where these say, not where Broyden's updates do.
  bool confirms = false;
  /// Told about where differences are taken from now on, and with nothing that they are done: the
  /// residuals between may be right to first order only. May be empty.
  std::function<void(const std::optional<Eigen::VectorXd>&)> linearise = {};
};

/// The x within bounds with the smallest |r(x)|^2, of residuals that cost much: Gauss-Newton steps
/// with one set of forward differences and Broyden's updates after it (C. G. Broyden, Math. Comput.
/// 19:577, 1965). A step that comes no nearer, or to where there are no residuals, is shortened;
/// where that does not help the differences are taken anew. Unsolved without residuals at the
/// start.
Outcome<Minimum> least_squares(const Residuals& residuals, const Eigen::VectorXd& start,
                               const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                               const LeastSquaresSearch& search);

}  // namespace lv::calibrate
