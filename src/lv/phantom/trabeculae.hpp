#pragma once

#include "lv/phantom/ventricle.hpp"

#include <cstdint>
#include <vector>

namespace lv::phantom {

/// The rim of trabeculae inside the endocardium: columns of muscle along the long axis, 1.2 to 2.8
/// mm thick and as thick at all times, so that contraction squeezes out the blood between them.
/// They turn with the wall and wander to and fro by some millimetres along it. At end-diastole, in
/// the middle of the ventricle, they fill three fifths of the area next to the wall, and less and
/// less inwards, nothing at the rim's depth. Labels, contours and volumes count the rim to the
/// cavity.
class Trabeculae {
 public:
  /// None where the ventricle's depth of the rim is 0. `seed` chooses where the columns lie.
  Trabeculae(const Ventricle& ventricle, std::uint32_t seed);

  /// Whether a point of the model frame in the cavity, at X at end-diastole, lies in a column.
  [[nodiscard]] bool contain(const Motion& motion, const Vec3& x, const Vec3& X) const;

 private:
  struct Column {
    double angle;   ///< at end-diastole [rad]
    double away;    ///< of its middle from the endocardium, inwards [mm]
    double radius;  ///< [mm]
    double wander;  ///< [mm]
    double length;  ///< along the long axis in which it wanders once [mm]
    double phase;   ///< [rad]
  };
  double depth_;
  std::vector<Column> columns_;
};

}  // namespace lv::phantom
