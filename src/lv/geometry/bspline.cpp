#include "lv/geometry/bspline.hpp"

#include <algorithm>
#include <cmath>

namespace lv::geometry {
namespace {

/// The basis functions of one degree on the interval [knot[k], knot[k+1]], k = 3; function i of
/// degree d starts at knot i + 3 - d (Cox and de Boor).
struct Degrees {
  std::array<double, 2> linear;
  std::array<double, 3> quadratic;
  std::array<double, 4> cubic;
};

template <std::size_t N>
std::array<double, N + 1> raised(const std::array<double, N>& lower, const double* t, double x) {
  constexpr int degree = N;
  constexpr int first = 3 - degree;  // the first function of this degree starts here
  std::array<double, N + 1> raised{};
  for (int i = 0; i < degree; ++i) {
    // lower[i] starts at knot first + 1 + i and spans `degree` intervals
    const double start = t[first + 1 + i];
    const double width = t[first + 1 + i + degree] - start;
    const double rise = (x - start) / width;
    raised[i] += (1.0 - rise) * lower[i];
    raised[i + 1] += rise * lower[i];
  }
  return raised;
}

Degrees degrees_at(const double* t, double x) {
  Degrees d{};
  d.linear = raised(std::array<double, 1>{1.0}, t, x);
  d.quadratic = raised(d.linear, t, x);
  d.cubic = raised(d.quadratic, t, x);
  return d;
}

/// The derivatives of one degree's functions from those of the degree below:
/// N'_i = p (N_i / (t_{i+p} - t_i) - N_{i+1} / (t_{i+p+1} - t_{i+1})).
template <std::size_t N>
std::array<double, N + 1> differentiated(const std::array<double, N>& lower, const double* t) {
  constexpr int degree = N;
  constexpr int first = 3 - degree;
  std::array<double, N + 1> slope{};
  for (int i = 0; i < degree; ++i) {
    const double rate = degree * lower[i] / (t[first + 1 + i + degree] - t[first + 1 + i]);
    slope[i] -= rate;
    slope[i + 1] += rate;
  }
  return slope;
}

}  // namespace

CubicBasis::CubicBasis(Ends ends, int intervals, double end)
    : ends_(ends), intervals_(intervals), end_(end) {
  for (int i = -3; i <= intervals + 3; ++i) {
    const int k = ends == Ends::clamped ? std::clamp(i, 0, intervals) : i;
    knots_.push_back(end * k / intervals);
  }
}

int CubicBasis::size() const {
  return ends_ == Ends::clamped ? intervals_ + 3 : intervals_;
}

CubicBasis::Local CubicBasis::at(double x) const {
  if (ends_ == Ends::periodic)
    x -= end_ * std::floor(x / end_);
  const int interval = std::clamp(static_cast<int>(x / step()), 0, intervals_ - 1);
  // a clamped spline goes on beyond its ends as the last interval's polynomial
  const double* t = knots_.data() + interval;  // t[3] <= x <= t[4]
  const Degrees d = degrees_at(t, x);
  Local local{};
  local.value = d.cubic;
  local.slope = differentiated(d.quadratic, t);
  local.curvature = differentiated(differentiated(d.linear, t), t);
  for (int i = 0; i < 4; ++i)
    local.index[i] =
        ends_ == Ends::clamped ? interval + i : (interval + i - 1 + intervals_) % intervals_;
  return local;
}

}  // namespace lv::geometry
