#include "lv/calibrate/least_squares.hpp"

#include "lv/base/check.hpp"
#include "lv/base/dense.hpp"

#include <fmt/format.h>
#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <limits>
#include <optional>

namespace lv::calibrate {
namespace {

constexpr double smallest_step = 1e-4;    // of x, relative to itself and at least of `longest`
constexpr int most_evaluations = 40;      // besides those for derivatives
constexpr double residual_nowhere = 1e6;  // a residual where the model has no equilibrium

/// r(x) as Eigen's minimiser wants it. Outside the bounds x counts as at them.
class Bounded {
 public:
  using Scalar = double;

  Bounded(const Residuals& residuals, const Eigen::VectorXd& low, const Eigen::VectorXd& high,
          double difference)
      : residuals_(residuals), low_(low), high_(high), difference_(difference) {}

  [[nodiscard]] Eigen::VectorXd inside(const Eigen::VectorXd& x) const {
    return x.cwiseMax(low_).cwiseMin(high_);
  }

  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    ++evaluations;
    const auto found = residuals_(inside(x));
    if (found || evaluations == 1)
      r = found.value();
    else
      r.setConstant(residual_nowhere);
    return 0;
  }

  int df(const Eigen::VectorXd& x, Eigen::MatrixXd& J) const {
    const Eigen::VectorXd here = inside(x);
    const Eigen::VectorXd r = residuals_(here).value();
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      Eigen::VectorXd moved = here;
      const double step = here[j] + difference_ <= high_[j] ? difference_ : -difference_;
      moved[j] += step;
      J.col(j) = (residuals_(moved).value() - r) / step;
      evaluations += 1;
    }
    return 0;
  }

  [[nodiscard]] Eigen::Index inputs() const { return low_.size(); }
  [[nodiscard]] Eigen::Index values() const { return values_; }
  void set_values(Eigen::Index values) { values_ = values; }

  mutable int evaluations = 0;

 private:
  const Residuals& residuals_;
  const Eigen::VectorXd& low_;
  const Eigen::VectorXd& high_;
  double difference_;
  Eigen::Index values_ = 0;
};

}  // namespace

Minimum least_squares(const Residuals& residuals, const Eigen::VectorXd& start,
                      const Eigen::VectorXd& low, const Eigen::VectorXd& high, double difference,
                      double longest) {
  Bounded bounded(residuals, low, high, difference);
  Minimum minimum{bounded.inside(start), {}, 0};
  bounded(minimum.x, minimum.r);
  bounded.set_values(minimum.r.size());
  LV_CHECK(minimum.r.size() >= minimum.x.size());
  Eigen::LevenbergMarquardt<Bounded> search(bounded);
  search.parameters.xtol = smallest_step;
  search.parameters.ftol = 1e-6;
  search.parameters.maxfev = most_evaluations;
  search.parameters.factor = longest;
  search.useExternalScaling = true;
  search.diag = Eigen::VectorXd::Ones(minimum.x.size());
  const auto status = search.minimize(minimum.x);
  using namespace Eigen::LevenbergMarquardtSpace;
  if (status == TooManyFunctionEvaluation || status == ImproperInputParameters)
    throw NoSolution(
        fmt::format("The least-squares fit did not come to an end in {} equilibria, |r| = {:.4g}",
                    bounded.evaluations, search.fnorm),
        "Fit fewer parameters, or start nearer to the values that are expected");
  minimum.x = bounded.inside(minimum.x);
  minimum.r = search.fvec;
  minimum.evaluations = bounded.evaluations;
  return minimum;
}

namespace {

/// Forward differences, backward ones at the upper bound and where there is no residual.
std::optional<Eigen::MatrixXd> differences(const Residuals& residuals, const Minimum& at,
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

/// Steps of the longest kind, and then ever shorter ones.
double steps_left(double way, const CostlySearch& search) {
  constexpr double usual_fall = 3.0;
  if (way < search.shortest)
    return 0.0;
  const double last = std::min(way, search.longest);
  return (way - last) / search.longest + 1.0 +
         std::log(last / search.shortest) / std::log(usual_fall);
}

}  // namespace

Outcome<Minimum> broyden_least_squares(const Residuals& residuals, const Eigen::VectorXd& start,
                                       const Eigen::VectorXd& low, const Eigen::VectorXd& high,
                                       const CostlySearch& search) {
  Minimum best{start.cwiseMax(low).cwiseMin(high), {}, 0};
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
      search.slopes ? search.slopes : differences(counted, best, high, search.difference);
  double longest = search.longest;
  while (J && best.evaluations < most_evaluations) {
    const Eigen::VectorXd full = -dense::least_squares(*J, best.r);
    const double shortening = std::min(1.0, longest / full.cwiseAbs().maxCoeff());
    const Eigen::VectorXd step = (best.x + shortening * full).cwiseMax(low).cwiseMin(high) - best.x;
    const double length = step.cwiseAbs().maxCoeff();
    if (search.expect)
      search.expect(steps_left(full.cwiseAbs().maxCoeff(), search));
    if (length < search.shortest) {
      if (fresh || longest == search.longest)
        break;
      J = differences(counted, best, high, search.difference);
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
