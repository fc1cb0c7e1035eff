#include "lv/calibrate/least_squares.hpp"

#include "lv/base/dense.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lv::calibrate {
namespace {

/// Some sets of differences, and steps.
int most_evaluations(Eigen::Index unknowns) {
  return 40 + 3 * static_cast<int>(unknowns);
}

/// Forward differences, backward ones at the upper bound and where there is no residual.
std::optional<Eigen::MatrixXd> columns(const Residuals& residuals, const Minimum& at,
                                       const Eigen::VectorXd& high, double difference) {
  Eigen::MatrixXd J(at.r.size(), at.x.size());
  for (Eigen::Index j = 0; j < at.x.size(); ++j) {
    bool found = false;
    for (const double step : {difference, -difference}) {
      if (found || at.x[j] + step > high[j])
        continue;
      Eigen::VectorXd moved = at.x;
      moved[j] += step;
      if (const auto r = residuals(moved)) {
        J.col(j) = (*r - at.r) / step;
        found = true;
      }
    }
    if (!found)
      return {};
  }
  return J;
}

std::optional<Eigen::MatrixXd> differences(const Residuals& residuals, const Minimum& at,
                                           const Eigen::VectorXd& high,
                                           const LeastSquaresSearch& search) {
  if (search.linearise)
    search.linearise(at.x);
  auto J = columns(residuals, at, high, search.difference);
  if (search.linearise)
    search.linearise({});
  return J;
}

/// Steps of the longest kind, and then ever shorter ones.
double steps_left(double way, const LeastSquaresSearch& search) {
  constexpr double usual_fall = 3.0;
  if (way < search.shortest)
    return 0.0;
  const double last = std::min(way, search.longest);
  return (way - last) / search.longest + 1.0 +
         std::log(last / search.shortest) / std::log(usual_fall);
}

}  // namespace

Outcome<Minimum> least_squares(const Residuals& residuals, const Eigen::VectorXd& start,
                               const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                               const LeastSquaresSearch& search) {
  Minimum best{start.cwiseMax(low).cwiseMin(high), {}};
  const Residuals counted = [&](const Eigen::VectorXd& x) {
    ++best.evaluations;
    return residuals(x);
  };
  const auto first = counted(best.x);
  if (!first)
    return first.why();
  best.r = *first;
  bool fresh = !search.slopes;
  std::optional<Eigen::MatrixXd> J =
      search.slopes ? search.slopes : differences(counted, best, high, search);
  double longest = search.longest;
  while (J && best.evaluations < most_evaluations(start.size())) {
    const Eigen::VectorXd full = -dense::least_squares(*J, best.r);
    const double shortening = std::min(1.0, longest / full.cwiseAbs().maxCoeff());
    const Eigen::VectorXd step = (best.x + shortening * full).cwiseMax(low).cwiseMin(high) - best.x;
    const double length = step.cwiseAbs().maxCoeff();
    if (search.expect)
      search.expect(steps_left(full.cwiseAbs().maxCoeff(), search));
    const double promised = best.r.squaredNorm() - (best.r + *J * full).squaredNorm();
    if (length < search.shortest || promised < search.negligible) {
      best.is_found = fresh || (!search.confirms && longest == search.longest);
      if (best.is_found)
        break;
      J = differences(counted, best, high, search);
      fresh = true;
      longest = search.longest;
      continue;
    }
    const auto r = counted(best.x + step);
    if (r)  // what was learnt counts wherever it leads
      *J += (*r - best.r - *J * step) * step.transpose() / step.squaredNorm();
    if (r && r->squaredNorm() < best.r.squaredNorm()) {
      best.x += step;
      best.r = *r;
      fresh = false;
      longest = std::min(search.longest, 2.0 * longest);
    } else {
      longest = 0.4 * length;
    }
  }
  if (J)
    best.slopes = std::move(*J);
  return best;
}

}  // namespace lv::calibrate
