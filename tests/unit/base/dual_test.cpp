#include "lv/base/dual.hpp"

#include <catch2/catch.hpp>

namespace {

using lv::Dual;

template <class T>
T sample(const T& x, const T& y) {
  using std::atan;
  using std::exp;
  using std::sqrt;
  return sqrt(x) * exp(-1.0 * y) / (1.0 + x * y) - atan(x - 2.0 * y) + x;
}

}  // namespace

TEST_CASE("a dual number's slopes are the derivatives of what it went through", "[unit][base]") {
  constexpr double x = 1.3;
  constexpr double y = 0.4;
  constexpr double h = 1e-6;
  const Dual<2> result = sample(Dual<2>::variable(x, 0), Dual<2>::variable(y, 1));
  CHECK(result.value == Approx(sample(x, y)).epsilon(1e-14));
  // second-order differences
  CHECK(result.slope[0] == Approx((sample(x + h, y) - sample(x - h, y)) / (2 * h)).epsilon(1e-8));
  CHECK(result.slope[1] == Approx((sample(x, y + h) - sample(x, y - h)) / (2 * h)).epsilon(1e-8));
}

TEST_CASE("the larger of two dual numbers brings its own slopes", "[unit][base]") {
  const auto x = Dual<1>::variable(3.0);
  CHECK(maximum(x, Dual<1>(2.0)).slope[0] == 1.0);
  CHECK(maximum(x, Dual<1>(4.0)).slope[0] == 0.0);
  CHECK(minimum(x, Dual<1>(4.0)).slope[0] == 1.0);
}
