#include "lv/strain/ring.hpp"

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <numbers>

namespace lv::strain {
namespace {

constexpr int rays_around = 180;
constexpr int layers = 8;
constexpr double step = 2.0 * std::numbers::pi / rays_around;

Vec2 direction(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

Vec2 mid_wall(const SliceWall& wall, double angle) {
  return 0.5 * (wall.endo(angle) + wall.epi(angle)) * direction(angle);
}

/// The sums that the best rigid rotation follows from.
class Rotation {
 public:
  void add(double weight, const Vec2& X, const Vec2& x) {
    weight_ += weight;
    X_ += weight * X;
    x_ += weight * x;
    product_ += weight * x * X.transpose();
  }
  /// From x towards y.
  [[nodiscard]] double angle() const {
    const Mat2 m = product_ - x_ * X_.transpose() / weight_;
    return std::atan2(m(1, 0) - m(0, 1), m(0, 0) + m(1, 1));
  }

 private:
  double weight_ = 0.0;
  Vec2 X_ = Vec2::Zero(), x_ = Vec2::Zero();
  Mat2 product_ = Mat2::Zero();
};

Ray ray_at(const SliceWall& wall, const Deformation& motion, double angle, Rotation& rotation) {
  const double inner = wall.endo(angle);
  const double outer = wall.epi(angle);
  const Vec2 out = direction(angle);
  const Vec2 around(-out.y(), out.x());
  Ray ray;
  ray.angle = angle;
  for (int k = 0; k < layers; ++k) {
    const double R = inner + (outer - inner) * (k + 0.5) / layers;
    const double area = R * step * (outer - inner) / layers;
    const Moved moved = motion(R * out);
    ray.area += area;
    ray.circumferential += area * 0.5 * ((moved.F * around).squaredNorm() - 1.0);
    ray.radial += area * 0.5 * ((moved.F * out).squaredNorm() - 1.0);
    rotation.add(area, R * out, moved.x);
  }
  ray.circumferential /= ray.area;
  ray.radial /= ray.area;
  const Vec2 before = mid_wall(wall, angle - 0.5 * step);
  const Vec2 after = mid_wall(wall, angle + 0.5 * step);
  ray.line_then = (after - before).norm();
  ray.line_now = (motion(after).x - motion(before).x).norm();
  ray.thickness_then = outer - inner;
  ray.thickness_now = (motion(outer * out).x - motion(inner * out).x).norm();
  return ray;
}

}  // namespace

SliceMotion follow(const SliceWall& wall, const Deformation& motion) {
  SliceMotion slice;
  Rotation rotation;
  for (int k = 0; k < rays_around; ++k)
    slice.rays.push_back(ray_at(wall, motion, k * step, rotation));
  slice.rotation = -rotation.angle();  // from the apex it is seen the other way round
  return slice;
}

RingStrain strain_of(const std::vector<Ray>& rays) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  if (rays.empty())
    return {missing, missing, missing, missing};
  Ray sum;
  for (const Ray& ray : rays) {
    sum.area += ray.area;
    sum.circumferential += ray.area * ray.circumferential;
    sum.radial += ray.area * ray.radial;
    sum.line_then += ray.line_then;
    sum.line_now += ray.line_now;
    sum.thickness_then += ray.thickness_then;
    sum.thickness_now += ray.thickness_now;
  }
  return {sum.circumferential / sum.area, sum.radial / sum.area, sum.line_now / sum.line_then - 1.0,
          sum.thickness_now / sum.thickness_then - 1.0};
}

}  // namespace lv::strain
