#pragma once

#include "lv/phantom/ventricle.hpp"

namespace lv::phantom {

/// Whether a point of the model frame, in the cavity, lies in one of two papillary muscles: round
/// columns along the long axis, between 0.3 and 0.75 of the cavity's length below the base, 120
/// degrees to either side of the septum, which the endocardium of the moment cuts at their outer
/// edge. They are as thick at all times. Labels and volumes count them to the cavity.
[[nodiscard]] bool in_papillary(const Ventricle& ventricle, const Motion& motion, const Vec3& x);

}  // namespace lv::phantom
