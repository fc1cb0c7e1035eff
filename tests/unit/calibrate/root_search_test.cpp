#include "lv/calibrate/root_search.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

using namespace lv;
using calibrate::CostlyModel;
using calibrate::FoundRoot;
using calibrate::RootSearch;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const VectorXd zero = (VectorXd(3) << 0.3, -0.2, 0.1).finished();
const MatrixXd coupled =
    (MatrixXd(3, 3) << 0.5, 0.1, 0.0, -0.3, -1.2, 0.4, 0.2, 0.6, 0.9).finished();

/// Curved and coupled; nothing at `zero`.
VectorXd misfits(const VectorXd& x) {
  const VectorXd d = x - zero;
  return coupled * d + 0.15 * d.cwiseProduct(d);
}

RootSearch three_unknowns() {
  RootSearch search;
  search.low = VectorXd::Constant(3, -1.0);
  search.high = VectorXd::Constant(3, 1.0);
  search.tolerance = 1e-3;
  search.accuracy = 1e-4;
  search.rough = 0.01;
  search.longest = 0.5;
  search.most = 30;
  return search;
}

/// Slopes that are a third off, each by another sign.
MatrixXd wrong_slopes(const VectorXd& /*x*/) {
  MatrixXd J = coupled;
  J.row(0) *= 1.3;
  J.row(1) *= 0.7;
  J(2, 0) = 0.0;
  return J;
}

}  // namespace

TEST_CASE("a root is found with slopes that are a third off, in few evaluations",
          "[unit][calibrate]") {
  std::vector<double> accuracies;
  const CostlyModel model{[&](const VectorXd& x, double accuracy) -> Outcome<VectorXd> {
                            accuracies.push_back(accuracy);
                            return misfits(x);
                          },
                          wrong_slopes};
  const auto found = calibrate::search_root(model, VectorXd::Zero(3), three_unknowns());
  REQUIRE(found);
  CHECK(found->found);
  CHECK((found->x - zero).cwiseAbs().maxCoeff() < 3e-3);
  CHECK(found->evaluations <= 8);
  CHECK(accuracies.front() == 0.01);
  CHECK(accuracies.back() == 1e-4);  // what is taken for the root is known well
}

TEST_CASE("a search without a root within the bounds ends there", "[unit][calibrate]") {
  const CostlyModel model{
      [&](const VectorXd& x, double) -> Outcome<VectorXd> { return misfits(x); }, wrong_slopes};
  RootSearch search = three_unknowns();
  search.high[0] = 0.1;
  const auto found = calibrate::search_root(model, VectorXd::Zero(3), search);
  REQUIRE(found);
  CHECK_FALSE(found->found);
  CHECK(found->x[0] == Approx(0.1));
  CHECK(found->evaluations < search.most);
}

TEST_CASE("a search keeps clear of places without an answer", "[unit][calibrate]") {
  int failures = 0;
  const CostlyModel model{[&](const VectorXd& x, double) -> Outcome<VectorXd> {
                            if (x[1] < -0.21) {
                              ++failures;
                              return Unsolved{"no equilibrium", ""};
                            }
                            return misfits(x);
                          },
                          wrong_slopes};
  const auto found = calibrate::search_root(model, VectorXd::Zero(3), three_unknowns());
  REQUIRE(found);
  CHECK(found->found);
  CHECK(failures > 0);
  CHECK(found->last_failure->what == "no equilibrium");
}

TEST_CASE("a search has nothing to begin with where the start has no answer", "[unit][calibrate]") {
  const CostlyModel model{[](const VectorXd&, double) -> Outcome<VectorXd> {
                            return Unsolved{"it does not beat", ""};
                          },
                          wrong_slopes};
  const auto found = calibrate::search_root(model, VectorXd::Zero(3), three_unknowns());
  CHECK_FALSE(found);
  CHECK(found.why().what == "it does not beat");
}

TEST_CASE("within wide bounds slopes lead to no misfits, within narrow ones to the least",
          "[unit][calibrate]") {
  const VectorXd r = coupled * zero;
  const auto left = [&](double bound) {
    return calibrate::least_within(coupled, r, VectorXd::Constant(3, -bound),
                                   VectorXd::Constant(3, bound));
  };
  CHECK(left(1.0).norm() < 1e-9);
  CHECK(left(0.0) == r);
  CHECK(left(0.15).norm() < r.norm());
  CHECK(left(0.15).norm() > 0.01);
  const VectorXd alone = calibrate::least_within(
      MatrixXd::Identity(3, 3), zero, VectorXd::Constant(3, -0.1), VectorXd::Constant(3, 0.1));
  CHECK((alone - VectorXd((VectorXd(3) << 0.2, -0.1, 0.0).finished())).norm() < 1e-12);
  CHECK(calibrate::least_within(MatrixXd::Zero(3, 3), r, -zero.cwiseAbs(), zero.cwiseAbs()) == r);
}
