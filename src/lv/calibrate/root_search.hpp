#pragma once

#include "lv/base/outcome.hpp"

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace lv::calibrate {

/// Misfits r(x), as many as unknowns, of a model whose answers cost much and come with an accuracy
/// that is asked for; and roughly what dr/dx is where the model was followed to last.
struct CostlyModel {
  std::function<Outcome<Eigen::VectorXd>(const Eigen::VectorXd& x, double accuracy)> misfits;
  /// Of a place whose misfits are known.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& x)> slopes;
};

/// How a root is looked for.
struct RootSearch {
  Eigen::VectorXd low, high;  ///< bounds of x
  double tolerance = 0.0;     ///< of every misfit
  double accuracy = 0.0;      ///< with which the root's misfits are to be known
  double rough = 0.0;         ///< with which those far off are
  double longest = 0.0;       ///< of each component's step
  int most = 0;               ///< times that misfits are asked for
};

/// Where the search came to.
struct FoundRoot {
  Eigen::VectorXd x, r;
  bool found = false;
  int evaluations = 0;
  std::optional<Unsolved> last_failure;  ///< of the last place without an answer, if there was one
};

/// Newton steps to r(x) = 0 with the slopes at hand, which are corrected by what the steps show
/// (C. G. Broyden, Math. Comput. 19:577, 1965): dr/dx = slopes(x) + D, and after a step s
///
///   D += (r(x + s) - r(x) - (slopes(x) + D) s) s^T/(s^T s).
///
/// A step that comes no nearer, or to where there is no answer, is shortened. Misfits are asked for
/// with an accuracy of a twentieth of the largest. Ends without a root at the bounds, where steps
/// no longer help, or after so many evaluations. Unsolved without an answer at the start.
[[nodiscard]] Outcome<FoundRoot> search_root(const CostlyModel& model, const Eigen::VectorXd& start,
                                             const RootSearch& search);

/// The smallest misfits r + J s of a step s within bounds, in the least squares: what a model that
/// goes on as its slopes say comes to.
[[nodiscard]] Eigen::VectorXd least_within(const Eigen::MatrixXd& J, const Eigen::VectorXd& r,
                                           const Eigen::VectorXd& low, const Eigen::VectorXd& high);

}  // namespace lv::calibrate
