#include "lv/phantom/papillary.hpp"

#include <cmath>

namespace lv::phantom {

bool in_papillary(const Ventricle& ventricle, const Motion& motion, const Vec3& x) {
  constexpr double top = 0.3;  // parts of the cavity's length
  constexpr double bottom = 0.75;
  constexpr double from_septum = 2.0 * std::numbers::pi / 3.0;
  const double depth = motion.Z(x.z()) / ventricle.cavity_apex();
  if (ventricle.papillary <= 0.0 || depth < top || depth > bottom)
    return false;
  for (const double angle : {from_septum, -from_septum}) {
    const double r = motion.radius(geometry::Side::endo, x.z(), angle) - 0.9 * ventricle.papillary;
    if (std::hypot(x.x() - r * std::cos(angle), x.y() - r * std::sin(angle)) < ventricle.papillary)
      return true;
  }
  return false;
}

}  // namespace lv::phantom
