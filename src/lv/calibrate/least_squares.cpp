#include "lv/calibrate/least_squares.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>
#include <unsupported/Eigen/NonLinearOptimization>

#include <limits>

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
    throw RunError(
        fmt::format("The least-squares fit did not come to an end in {} equilibria, |r| = {:.4g}",
                    bounded.evaluations, search.fnorm),
        "Fit fewer parameters, or start nearer to the values that are expected");
  minimum.x = bounded.inside(minimum.x);
  minimum.r = search.fvec;
  minimum.evaluations = bounded.evaluations;
  return minimum;
}

}  // namespace lv::calibrate
