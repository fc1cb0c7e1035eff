#include "lv/phantom/trabeculae.hpp"

#include "lv/phantom/random.hpp"

#include <cmath>

namespace lv::phantom {
namespace {

using std::numbers::pi;

constexpr double thinnest = 0.6;  // radius of a column [mm]
constexpr double thickest = 1.4;

}  // namespace

Trabeculae::Trabeculae(const Ventricle& ventricle, std::uint32_t seed)
    : depth_(ventricle.trabeculae) {
  if (depth_ <= 0.0)
    return;
  constexpr double filled = 0.6;  // next to the wall
  constexpr double behind = 1.0;  // columns begin so far in the wall [mm]
  Random random(seed + 0x200000000ULL);
  // columns overlap: of areas that sum up to the part s, 1 - exp(-s) is filled; s falls linearly
  const double rim = 2.0 * pi * ventricle.shape.endo_radius * (depth_ + behind);
  for (double left = -0.5 * std::log(1.0 - filled) * rim; left > 0.0;) {
    Column column{};
    column.angle = random.uniform(-pi, pi);
    column.away = (depth_ + behind) * (1.0 - std::sqrt(random.uniform())) - behind;
    column.radius = random.uniform(thinnest, thickest);
    column.wander = random.uniform(1.0, 3.0);
    column.length = random.uniform(25.0, 60.0);
    column.phase = random.uniform(-pi, pi);
    columns_.push_back(column);
    left -= pi * column.radius * column.radius;
  }
}

bool Trabeculae::contain(const Motion& motion, const Vec3& x, const Vec3& X) const {
  if (columns_.empty())
    return false;
  const double r = std::hypot(x.x(), x.y());
  const double away = motion.radius(geometry::Side::endo, x.z(), std::atan2(x.y(), x.x())) - r;
  if (away > depth_ + thickest)
    return false;
  const double Theta = std::atan2(X.y(), X.x());
  for (const Column& c : columns_) {
    const double along = r * std::remainder(Theta - c.angle, 2.0 * pi) -
                         c.wander * std::sin(2.0 * pi * X.z() / c.length + c.phase);
    if (std::hypot(along, away - c.away) < c.radius)
      return true;
  }
  return false;
}

}  // namespace lv::phantom
