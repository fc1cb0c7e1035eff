#include "lv/segment/coils.hpp"

#include "lv/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lv::segment {
namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

constexpr double darkest = 0.8;  // of the fit; below lies muscle

Vec2 at(int ray, int k, const PolarGrid& grid) {
  return grid.radius(k) * Vec2(std::cos(grid.angle(ray)), std::sin(grid.angle(ray)));
}

/// Sums over places x of a frame, each weighted with its area, of x and y = ln v.
struct Moments {
  double weight = 0.0, y = 0.0;
  Vec2 x = Vec2::Zero(), xy = Vec2::Zero();
  Mat2 xx = Mat2::Zero();

  void add(double w, const Vec2& place, double value) {
    weight += w;
    x += w * place;
    y += w * value;
    xx += w * place * place.transpose();
    xy += w * value * place;
  }
};

/// ln v of a frame's blood without the gradient.
double level_of(const Polar& values, int radii, const CoilGradient& gradient,
                const PolarGrid& grid) {
  std::vector<double> inner;
  for (int i = 0; i < grid.rays; ++i)
    for (int k = 0; k < radii; ++k)
      if (values(i, k) > 0.0)
        inner.push_back(std::log(values(i, k)) - gradient.dot(at(i, k, grid)));
  return inner.empty() ? std::numeric_limits<double>::infinity() : median(std::move(inner));
}

/// The moments of what is blood by a gradient known so far.
Moments moments_of(const Polar& values, int radii, const CoilGradient& gradient,
                   const PolarGrid& grid) {
  const double level = level_of(values, radii, gradient, grid);
  Moments sums;
  for (int i = 0; i < grid.rays; ++i)
    for (int k = 0; k < radii; ++k) {
      const Vec2 x = at(i, k, grid);
      if (values(i, k) > 0.0 &&
          std::log(values(i, k)) > level + gradient.dot(x) + std::log(darkest))
        sums.add(grid.radius(k), x, std::log(values(i, k)));
    }
  return sums;
}

/// The gradient of least squares over the frames of one slice.
CoilGradient gradient_in(const BloodPool& pool, const PolarGrid& grid) {
  constexpr int rounds = 4;  // of telling blood from muscle
  const int radii = grid.index(pool.radius) + 1;
  CoilGradient gradient = CoilGradient::Zero();
  for (int round = 0; round < rounds; ++round) {
    Mat2 A = Mat2::Identity();  // a square millimetre: keeps it regular without blood
    Vec2 b = Vec2::Zero();
    for (const Polar& values : pool.frames) {
      const Moments m = moments_of(values, radii, gradient, grid);
      if (!(m.weight > 0.0))
        continue;
      A += m.xx - m.x * m.x.transpose() / m.weight;
      b += m.xy - m.x * m.y / m.weight;
    }
    gradient = A.inverse() * b;
  }
  return gradient;
}

}  // namespace

CoilGradient coil_gradient(const std::vector<BloodPool>& pools, const PolarGrid& grid) {
  const double steepest = std::log(4.0) / 100.0;
  if (pools.empty())
    return CoilGradient::Zero();
  std::vector<double> along, down;
  for (const BloodPool& pool : pools) {
    const CoilGradient own = gradient_in(pool, grid);
    along.push_back(own.x());
    down.push_back(own.y());
  }
  const CoilGradient gradient(median(std::move(along)), median(std::move(down)));
  return gradient * std::min(1.0, steepest / std::max(gradient.norm(), 1e-12));
}

Polar sensitivity(const CoilGradient& gradient, const PolarGrid& grid) {
  Polar field(grid.rays, grid.radii);
  for (int i = 0; i < grid.rays; ++i)
    for (int k = 0; k < grid.radii; ++k)
      field(i, k) = std::exp(gradient.dot(at(i, k, grid)));
  return field;
}

}  // namespace lv::segment
