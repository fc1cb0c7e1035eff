#include "lv/immersed/delta.hpp"

#include <catch2/catch.hpp>

#include <functional>

namespace {

using namespace lv::immersed;

/// sum of weight x f(grid point - s)
double moment(const AxisWeights& w, double s, const std::function<double(double)>& f) {
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
    sum += w.weight[i] * f(w.first + i - s);
  return sum;
}

constexpr auto axis_kernels = {peskin4, cubic_bspline, quadratic_bspline};
constexpr double rounding = 1e-14;  // coordinates up to 40

/// Calls check(s) for points all over a cell, on grid points and half way between them.
template <class Check>
void for_coordinates(const Check& check) {
  for (int i = -400; i <= 400; ++i)
    check(i / 20.0 + (i % 3) * 0.0123);
}

}  // namespace

TEST_CASE("kernels are positive, sum to one and have no first moment", "[unit][immersed]") {
  for (const auto kernel : axis_kernels) {
    for_coordinates([&](double s) {
      const AxisWeights w = kernel(s);
      for (const double weight : w.weight)
        CHECK(weight >= -rounding);
      CHECK(moment(w, s, [](double) { return 1.0; }) == Approx(1.0).epsilon(rounding));
      CHECK(moment(w, s, [](double r) { return r; }) == Approx(0.0).margin(rounding));
    });
  }
}

TEST_CASE("kernels reach no further than two cells", "[unit][immersed]") {
  for (const auto kernel : axis_kernels) {
    for_coordinates([&](double s) {
      const AxisWeights w = kernel(s);
      for (int i = 0; i < 4; ++i)
        if (std::abs(w.first + i - s) >= 2.0)
          CHECK(std::abs(w.weight[i]) < rounding);
    });
  }
}

TEST_CASE("Peskin's kernel treats even and odd points alike and has a constant sum of squares",
          "[unit][immersed]") {
  for_coordinates([](double s) {
    const AxisWeights w = peskin4(s);
    CHECK(w.weight[0] + w.weight[2] == Approx(0.5).epsilon(rounding));
    CHECK(w.weight[1] + w.weight[3] == Approx(0.5).epsilon(rounding));
    double squares = 0.0;
    for (const double weight : w.weight)
      squares += weight * weight;
    CHECK(squares == Approx(0.375).epsilon(rounding));
  });
}

TEST_CASE("Peskin's kernel is the function it says", "[unit][immersed]") {
  const auto phi = [](double r) {
    r = std::abs(r);
    return r <= 1.0 ? (3 - 2 * r + std::sqrt(1 + 4 * r - 4 * r * r)) / 8
                    : (5 - 2 * r - std::sqrt(std::max(0.0, -7 + 12 * r - 4 * r * r))) / 8;
  };
  for_coordinates([&](double s) {
    const AxisWeights w = peskin4(s);
    for (int i = 0; i < 4; ++i)  // the root loses half the digits where it vanishes
      CHECK(w.weight[i] == Approx(phi(w.first + i - s)).margin(1e-7));
  });
}

TEST_CASE("B-splines have the variance of sums of uniform spreads", "[unit][immersed]") {
  const auto square = [](double r) { return r * r; };
  for_coordinates([&](double s) {
    CHECK(moment(cubic_bspline(s), s, square) == Approx(4.0 / 12.0).epsilon(1e-12));
    CHECK(moment(quadratic_bspline(s), s, square) == Approx(3.0 / 12.0).epsilon(1e-12));
  });
}

TEST_CASE("the composite kernel is cubic along a component's own axis and quadratic across",
          "[unit][immersed]") {
  const auto same = [](const AxisWeights& a, const AxisWeights& b) {
    return a.first == b.first && a.weight == b.weight;
  };
  CHECK(same(axis_weights(Kernel::composite_bspline, 3.3, true), cubic_bspline(3.3)));
  CHECK(same(axis_weights(Kernel::composite_bspline, 3.3, false), quadratic_bspline(3.3)));
  for (const bool own_axis : {true, false})
    CHECK(same(axis_weights(Kernel::peskin4, 3.3, own_axis), peskin4(3.3)));
}
