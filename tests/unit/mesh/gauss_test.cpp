#include "lv/mesh/gauss.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace lv;

TEST_CASE("n Gauss points integrate polynomials of degree 2n - 1 and no higher", "[unit][mesh]") {
  for (int n = 1; n <= 7; ++n) {
    const auto points = mesh::gauss(n);
    REQUIRE(points.size() == static_cast<std::size_t>(n));
    CHECK(std::is_sorted(points.begin(), points.end(),
                         [](const auto& a, const auto& b) { return a.x < b.x; }));
    const auto integral = [&](int degree) {
      double sum = 0.0;
      for (const mesh::LinePoint& point : points)
        sum += point.weight * std::pow(point.x, degree);
      return sum;
    };
    for (int degree = 0; degree < 2 * n; ++degree)
      CHECK(integral(degree) == Approx(1.0 / (degree + 1)).epsilon(1e-13));
    CHECK(std::abs(integral(2 * n) - 1.0 / (2 * n + 1)) > 1e-10);
  }
}
