#include "lv/calibrate/least_squares.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lv;
using namespace lv::calibrate;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const VectorXd times = VectorXd::LinSpaced(9, 0.0, 2.0);

/// exp(x0 - x1 t) minus numbers that no such curve meets.
VectorXd misfit(const VectorXd& x) {
  VectorXd r(times.size());
  for (Eigen::Index i = 0; i < r.size(); ++i)
    r[i] = std::exp(x[0] - x[1] * times[i]) - 2.0 * std::exp(-0.7 * times[i]) -
           0.3 * std::cos(5.0 * times[i]);
  return r;
}

MatrixXd slopes(const VectorXd& x) {
  MatrixXd J(times.size(), 2);
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    const double value = std::exp(x[0] - x[1] * times[i]);
    J.row(i) << value, -times[i] * value;
  }
  return J;
}

const VectorXd far_below = VectorXd::Constant(2, -5.0);
const VectorXd far_above = VectorXd::Constant(2, 5.0);
const LeastSquaresSearch confirmed{
    .difference = 1e-5, .longest = 0.25, .shortest = 1e-7, .confirms = true};

}  // namespace

TEST_CASE("a minimum of residuals that stay large is one by fresh slopes", "[unit][calibrate]") {
  const auto minimum = least_squares([](const VectorXd& x) { return misfit(x); }, VectorXd::Zero(2),
                                     far_below, far_above, confirmed);
  REQUIRE(minimum);
  CHECK(minimum->is_found);
  CHECK(minimum->r.norm() > 0.3);
  const VectorXd descent = slopes(minimum->x).transpose() * minimum->r;
  CHECK(descent.norm() < 1e-4 * slopes(minimum->x).norm() * minimum->r.norm());
}

TEST_CASE("a minimum may lie at a bound", "[unit][calibrate]") {
  VectorXd high = far_above;
  high[0] = 0.1;
  const auto minimum = least_squares([](const VectorXd& x) { return misfit(x); }, VectorXd::Zero(2),
                                     far_below, high, confirmed);
  REQUIRE(minimum);
  CHECK(minimum->x[0] == 0.1);
  const VectorXd descent = slopes(minimum->x).transpose() * minimum->r;
  CHECK(descent[0] < 0.0);  // it would go on beyond the bound
}

TEST_CASE("a step to where there are no residuals is shortened", "[unit][calibrate]") {
  const auto with_hole = [](const VectorXd& x) -> Outcome<VectorXd> {
    if (x[0] > 0.2 && x[1] < 0.2)
      return Unsolved{"a hole", ""};
    return misfit(x);
  };
  const auto minimum = least_squares(with_hole, VectorXd::Zero(2), far_below, far_above, confirmed);
  REQUIRE(minimum);
  const auto free = least_squares([](const VectorXd& x) { return misfit(x); }, VectorXd::Zero(2),
                                  far_below, far_above, confirmed);
  CHECK((minimum->x - free->x).norm() < 1e-3);
}

TEST_CASE("a search that creeps along a flat valley ends where whole steps promise little",
          "[unit][calibrate]") {
  const auto valley = [](const VectorXd& x) -> Outcome<VectorXd> {
    VectorXd r(2);
    r << 0.1 * x[0], 5.0 - 9e-4 * x[0] * x[0];  // steps lead a tenth of the way
    return r;
  };
  LeastSquaresSearch search{.difference = 1e-2, .longest = 1.0, .shortest = 1e-4, .confirms = true};
  const VectorXd start = VectorXd::Constant(1, 20.0), high = VectorXd::Constant(1, 50.0);
  CHECK_FALSE(least_squares(valley, start, -high, high, search)->is_found);
  search.negligible = 1e-2;
  const auto minimum = least_squares(valley, start, -high, high, search);
  CHECK(minimum->is_found);
  CHECK(std::abs(minimum->x[0]) < 10.0);  // one standard error
}
