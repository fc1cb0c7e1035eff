#include "lv/calibrate/posterior.hpp"

#include <catch2/catch.hpp>

using namespace lv;

TEST_CASE("of one datum and a penalty the posterior is that of their precisions",
          "[unit][calibrate]") {
  constexpr double slope = 0.05, error = 0.03, spread = 0.5;
  const Eigen::MatrixXd J{{slope / error}, {1.0 / spread}};
  const calibrate::Posterior p = calibrate::posterior(J, 1);
  const double data = slope * slope / (error * error);
  const double penalty = 1.0 / (spread * spread);
  CHECK(p.covariance(0, 0) == Approx(1.0 / (data + penalty)));
  CHECK(p.resolution[0] == Approx(data / (data + penalty)));
}

TEST_CASE("without a penalty the data determine all, and without data the penalty does",
          "[unit][calibrate]") {
  const Eigen::MatrixXd J{{3.0, 1.0}, {0.5, 2.0}, {1.0, -1.0}};
  const calibrate::Posterior all = calibrate::posterior(J, 0);
  CHECK(all.resolution[0] == Approx(1.0));
  CHECK(all.resolution.sum() == Approx(2.0));
  const Eigen::MatrixXd blind{{0.0, 2.0}, {2.0, 0.0}, {0.0, 2.0}};  // the datum sees the second
  const calibrate::Posterior half = calibrate::posterior(blind, 2);
  CHECK(half.resolution[0] == Approx(0.0).margin(1e-12));
  CHECK(half.covariance(0, 0) == Approx(0.25));
  CHECK(half.resolution[1] == Approx(0.5));
}
