#include "lv/segment/closed_path.hpp"

#include "lv/segment/smooth_border.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

using namespace lv::segment;

namespace {

double cost_of(const std::vector<int>& path, const Polar& cost, const PathRule& rule) {
  double sum = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const int change = path[i] - path[(i + path.size() - 1) % path.size()];
    if (std::abs(change) > rule.reach)
      return std::numeric_limits<double>::infinity();
    sum += cost(static_cast<Eigen::Index>(i), path[i]) + rule.stiffness * change * change;
  }
  return sum;
}

bool runs_through(const std::vector<int>& path, const std::vector<Fixed>& fixed) {
  return std::all_of(fixed.begin(), fixed.end(), [&](const Fixed& at) {
    return path[static_cast<std::size_t>(at.ray)] == at.k;
  });
}

/// The least cost of all closed paths through given radii, tried one by one.
double least_cost(const Polar& cost, const PathRule& rule, const std::vector<Fixed>& fixed = {}) {
  std::vector<int> path(static_cast<std::size_t>(cost.rows()), 0);
  double least = std::numeric_limits<double>::infinity();
  for (;;) {
    if (runs_through(path, fixed))
      least = std::min(least, cost_of(path, cost, rule));
    std::size_t i = 0;
    while (i < path.size() && ++path[i] == cost.cols())
      path[i++] = 0;
    if (i == path.size())
      return least;
  }
}

Radii circle(double radius) {
  return Radii::Constant(72, radius);
}

}  // namespace

TEST_CASE("no closed path costs less than the one found", "[segment]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int trial = 0; trial < 60; ++trial) {
    Polar cost(6, 5);
    for (double& c : cost.reshaped())
      c = number(random);
    const PathRule rule{.reach = 1 + trial % 2, .stiffness = 0.1 * (trial % 4)};
    CHECK(cost_of(closed_path(cost, rule), cost, rule) == Approx(least_cost(cost, rule)));
  }
}

TEST_CASE("no closed path through given radii costs less than the one found", "[segment]") {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int trial = 0; trial < 60; ++trial) {
    Polar cost(6, 5);
    for (double& c : cost.reshaped())
      c = number(random);
    std::vector<Fixed> fixed{{1, trial % 5}};
    if (trial % 3 > 0)
      fixed.push_back({4, (trial / 5) % 5});
    // from one to the other are three rays: radii 0 and 4 need steps of two
    const bool steep = fixed.size() == 2 && std::abs(fixed[0].k - fixed[1].k) > 3;
    const PathRule rule{.reach = 1, .stiffness = 0.1 * (trial % 4)};
    const PathRule grown{.reach = steep ? 2 : 1, .stiffness = rule.stiffness};
    const std::vector<int> path = closed_path(cost, rule, fixed);
    CHECK(runs_through(path, fixed));
    CHECK(cost_of(path, cost, grown) == Approx(least_cost(cost, grown, fixed)));
  }
}

TEST_CASE("the convex hull fills a dent and leaves a circle", "[segment]") {
  CHECK((convex(circle(20.0)) - 20.0).abs().maxCoeff() == Approx(0.0).margin(1e-9));
  Radii dented = circle(20.0);
  dented.segment(10, 5) = 12.0;  // rays 10 to 14, between points on 9 and 15
  const Radii hull = convex(dented);
  CHECK(hull(12) == Approx(20.0 * std::cos(3.0 * 2.0 * M_PI / 72)));
  CHECK(hull(40) == Approx(20.0));
}

TEST_CASE("a papillary muscle pushes the fitted border inwards by less than a third", "[segment]") {
  Radii seen = circle(25.0);
  seen.segment(20, 8) = 16.0;
  const Radii one = Radii::Ones(72);
  BorderFit fit{seen, one, seen, Radii::Zero(72), 3, 0.1};
  const double with_dent = fit_border(fit)(24);
  fit.within = 1.0;
  CHECK(with_dent > 25.0 - 9.0 / 3.0);
  CHECK(with_dent > fit_border(fit)(24) + 1.0);
}

TEST_CASE("a border that is not seen takes the expected place", "[segment]") {
  Radii weight = Radii::Ones(72);
  weight.head(20) = 1e-3;
  Radii seen = circle(20.0);
  seen.head(20) = 35.0;
  const Radii fit = fit_border({seen, weight, circle(20.0), 1.0 - weight, 3, 1.0});
  CHECK((fit - 20.0).abs().maxCoeff() < 0.1);
}

TEST_CASE("area and centroid are those of a circle off the centre", "[segment]") {
  Radii r(720);
  for (int i = 0; i < 720; ++i) {  // radius 20, centre at (5, 0)
    const double a = 2.0 * M_PI * i / 720;
    r(i) = 5.0 * std::cos(a) + std::sqrt(400.0 - 25.0 * std::sin(a) * std::sin(a));
  }
  CHECK(area(r) == Approx(M_PI * 400.0).epsilon(1e-3));
  CHECK(centroid(r).x() == Approx(5.0).epsilon(1e-2));
  CHECK(centroid(r).y() == Approx(0.0).margin(1e-9));
}

TEST_CASE("no open path costs less than the one found", "[segment]") {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int trial = 0; trial < 40; ++trial) {
    Polar cost(5, 4);
    for (double& c : cost.reshaped())
      c = number(random);
    const PathRule rule{.reach = 1 + trial % 2, .stiffness = 0.1 * (trial % 4)};
    const auto open_cost = [&](const std::vector<int>& path) {
      double sum = cost(0, path[0]);
      for (std::size_t i = 1; i < path.size(); ++i) {
        const int change = path[i] - path[i - 1];
        if (std::abs(change) > rule.reach)
          return std::numeric_limits<double>::infinity();
        sum += cost(static_cast<Eigen::Index>(i), path[i]) + rule.stiffness * change * change;
      }
      return sum;
    };
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 1024; ++n)  // all paths of five rays of four radii
      least = std::min(least, open_cost({n % 4, n / 4 % 4, n / 16 % 4, n / 64 % 4, n / 256}));
    CHECK(open_cost(open_path(cost, rule)) == Approx(least));
  }
}
