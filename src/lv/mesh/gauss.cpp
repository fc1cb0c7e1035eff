#include "lv/mesh/gauss.hpp"

#include "lv/base/check.hpp"

#include <boost/math/special_functions/legendre.hpp>

#include <algorithm>

namespace lv::mesh {
namespace {

template <std::size_t N>
std::vector<LinePoint> as_vector(const std::array<LinePoint, N>& points) {
  return {points.begin(), points.end()};
}

}  // namespace

std::vector<LinePoint> gauss(int count) {
  LV_CHECK(count > 0);
  if (count == 2)
    return as_vector(gauss<2>());
  if (count == 3)
    return as_vector(gauss<3>());
  std::vector<LinePoint> points;
  for (const double x : boost::math::legendre_p_zeros<double>(count)) {  // of [-1, 1], from 0 on
    const double slope = boost::math::legendre_p_prime(count, x);
    const double weight = 1.0 / ((1.0 - x * x) * slope * slope);
    points.push_back({0.5 * (1.0 + x), weight});
    if (x != 0.0)
      points.push_back({0.5 * (1.0 - x), weight});
  }
  std::sort(points.begin(), points.end(),
            [](const LinePoint& a, const LinePoint& b) { return a.x < b.x; });
  return points;
}

}  // namespace lv::mesh
