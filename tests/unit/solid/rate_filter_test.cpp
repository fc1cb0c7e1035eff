#include "lv/solid/rate_filter.hpp"

#include "support/random_values.hpp"
#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

namespace {

using namespace lv;
using solid::RateFilter;

/// A cloud of nodes in a box of 30 x 20 x 10 mm with different volumes and tensions.
struct Cloud {
  Cloud() {
    test::RandomValues random(1);
    for (int i = 0; i < 500; ++i) {
      nodes.push_back(random.vector().cwiseProduct(Vec3(15, 10, 5)));
      volumes.push_back(12.0 * (1.0 + 0.5 * random()));
      tension.push_back(60.0 * (1.0 + 0.9 * random()));
    }
  }
  [[nodiscard]] std::vector<double> random_rates(unsigned seed) const {
    test::RandomValues random(seed);
    std::vector<double> rates(nodes.size());
    for (double& r : rates)
      r = random();
    return rates;
  }
  [[nodiscard]] std::vector<double> smoothed(std::vector<double> rates, double width) const {
    RateFilter(nodes, volumes).smooth(tension, width, rates);
    return rates;
  }
  /// sum V T_0 a b
  [[nodiscard]] double product(const std::vector<double>& a, const std::vector<double>& b) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += volumes[i] * tension[i] * a[i] * b[i];
    return sum;
  }

  std::vector<Vec3> nodes;
  std::vector<double> volumes, tension;
};

/// How much a wave of wave number k along x is weakened: sum r r~ / sum r r over both phases, on a
/// line of densely and evenly spaced nodes, 200 mm long.
double transmission(double k, double width) {
  constexpr int n = 20001;
  std::vector<Vec3> nodes;
  for (int i = 0; i < n; ++i)
    nodes.emplace_back(0.01 * i, 0.0, 0.0);
  const std::vector<double> ones(n, 1.0);
  RateFilter filter(nodes, std::vector<double>(n, 1e-6));
  double product = 0.0;
  for (const double phase : {0.0, 0.5 * M_PI}) {
    std::vector<double> wave;
    for (const Vec3& X : nodes)
      wave.push_back(std::cos(k * X.x() + phase));
    std::vector<double> smooth = wave;
    filter.smooth(ones, width, smooth);
    product += std::inner_product(wave.begin(), wave.end(), smooth.begin(), 0.0);
  }
  return product / n;  // cos^2 + sin^2 = 1
}

}  // namespace

TEST_CASE("the filter leaves a rate alone that is the same everywhere", "[unit][solid]") {
  const Cloud cloud;
  for (const double width : {2.0, 5.0, 17.3, 100.0})
    for (const double rate : cloud.smoothed(std::vector<double>(500, -3.0), width))
      CHECK(rate == Approx(-3.0).epsilon(1e-13));
}

TEST_CASE("the filter conserves the weighted sum of the rates", "[unit][solid]") {
  const Cloud cloud;
  const auto rates = cloud.random_rates(2);
  const std::vector<double> ones(500, 1.0);
  for (const double width : {2.0, 5.0, 100.0}) {
    const auto smooth = cloud.smoothed(rates, width);
    CHECK(smooth != rates);
    // 500 terms of 1e3
    CHECK(cloud.product(ones, smooth) == Approx(cloud.product(ones, rates)).margin(1e-9));
  }
}

TEST_CASE("the filter is symmetric in the weights and never adds to a rate's size",
          "[unit][solid]") {
  const Cloud cloud;
  const auto a = cloud.random_rates(3);
  const auto b = cloud.random_rates(4);
  for (const double width : {2.0, 5.0, 100.0}) {
    const auto Sa = cloud.smoothed(a, width);
    const auto Sb = cloud.smoothed(b, width);
    CHECK(cloud.product(a, Sb) == Approx(cloud.product(Sa, b)).margin(1e-9));
    CHECK(cloud.product(a, Sa) >= 0.0);
    CHECK(cloud.product(a, Sa) <= cloud.product(a, a));
    CHECK(cloud.product(Sa, Sa) <= cloud.product(a, a));
  }
}

TEST_CASE("the filter multiplies the stiffness of wave number k by sinc^4(kH/2)", "[unit][solid]") {
  constexpr double H = 4.0;
  for (const double y : {0.2, 0.7, 1.1656, 2.0, 2.8}) {
    const double sinc = std::sin(y) / y;
    // the ends of the line, one hat of 50 each
    CHECK(transmission(2.0 * y / H, H) == Approx(std::pow(sinc, 4)).margin(0.01));
  }
}

TEST_CASE("hats narrower than half the distance of nodes change nothing", "[unit][solid]") {
  const Cloud cloud;
  const auto rates = cloud.random_rates(5);
  const double narrowest =
      0.5 * std::cbrt(std::accumulate(cloud.volumes.begin(), cloud.volumes.end(), 0.0) / 500.0);
  CHECK(cloud.smoothed(rates, 0.99 * narrowest) == rates);
  CHECK(cloud.smoothed(rates, 1.01 * narrowest) != rates);
  CHECK(cloud.smoothed(rates, 0.0) == rates);
}

TEST_CASE("muscle without tension anywhere near has a rate of zero", "[unit][solid]") {
  Cloud cloud;
  cloud.tension.assign(500, 0.0);
  for (const double rate : cloud.smoothed(cloud.random_rates(6), 5.0))
    CHECK(rate == 0.0);
}

TEST_CASE("the stable width grows with wave speed and step", "[unit][solid]") {
  const double width = RateFilter::stable_width(1.5e5, 1e-4);
  CHECK(width > 0.0);
  CHECK(RateFilter::stable_width(3.0e5, 1e-4) == Approx(2.0 * width));
  CHECK(RateFilter::stable_width(1.5e5, 2e-4) == Approx(2.0 * width));
  CHECK(RateFilter::stable_width(0.0, 1e-4) == 0.0);
}
