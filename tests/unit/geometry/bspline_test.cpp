#include "lv/geometry/bspline.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace {

using lv::geometry::CubicBasis;
using Ends = CubicBasis::Ends;

struct Value {
  double value = 0.0, slope = 0.0, curvature = 0.0;
};

/// The spline with the given coefficients.
Value spline(const CubicBasis& basis, const std::vector<double>& c, double x) {
  const auto local = basis.at(x);
  Value v;
  for (int i = 0; i < 4; ++i) {
    v.value += c[local.index[i]] * local.value[i];
    v.slope += c[local.index[i]] * local.slope[i];
    v.curvature += c[local.index[i]] * local.curvature[i];
  }
  return v;
}

std::vector<double> some_coefficients(int n) {
  std::vector<double> c;
  for (int i = 0; i < n; ++i)
    c.push_back(std::sin(1.7 * i * i + 0.3));
  return c;
}

}  // namespace

TEST_CASE("B-spline bases sum to one", "[unit][geometry]") {
  for (const Ends ends : {Ends::clamped, Ends::periodic}) {
    const CubicBasis basis(ends, 7, 2.5);
    const std::vector<double> ones(basis.size(), 1.0);
    for (double x = 0.0; x <= 2.5; x += 0.05) {
      const Value v = spline(basis, ones, x);
      CHECK(v.value == Approx(1.0));
      CHECK(v.slope == Approx(0.0).margin(1e-12));
      CHECK(v.curvature == Approx(0.0).margin(1e-10));
    }
  }
}

TEST_CASE("B-spline derivatives are those of the values", "[unit][geometry]") {
  for (const Ends ends : {Ends::clamped, Ends::periodic}) {
    const CubicBasis basis(ends, 6, 3.0);
    const auto c = some_coefficients(basis.size());
    constexpr double h = 1e-5;
    for (double x = 0.02; x < 2.98; x += 0.07) {
      const Value low = spline(basis, c, x - h);
      const Value high = spline(basis, c, x + h);
      const Value at = spline(basis, c, x);
      CHECK(at.slope == Approx((high.value - low.value) / (2.0 * h)).margin(1e-7));
      CHECK(at.curvature == Approx((high.slope - low.slope) / (2.0 * h)).margin(1e-3));
    }
  }
}

TEST_CASE("B-splines are twice continuous over their knots and periods", "[unit][geometry]") {
  constexpr double h = 1e-9;
  const CubicBasis around(Ends::periodic, 8, 2.0 * std::numbers::pi);
  const auto c = some_coefficients(around.size());
  for (int k = 0; k <= 8; ++k) {
    const Value before = spline(around, c, k * around.step() - h);
    const Value after = spline(around, c, k * around.step() + h);
    CHECK(before.value == Approx(after.value).margin(1e-7));
    CHECK(before.slope == Approx(after.slope).margin(1e-7));
    CHECK(before.curvature == Approx(after.curvature).margin(1e-6));
  }
}

TEST_CASE("a clamped B-spline starts and ends at its outer coefficients", "[unit][geometry]") {
  const CubicBasis basis(Ends::clamped, 5, 1.5);
  const auto c = some_coefficients(basis.size());
  CHECK(spline(basis, c, 0.0).value == Approx(c.front()));
  CHECK(spline(basis, c, 1.5).value == Approx(c.back()));
}
