#pragma once

#include "lv/material/land2017.hpp"
#include "lv/material/niederer_hunter_smith.hpp"

#include <variant>

namespace lv::material {

/// A tension that the activation s sets, whatever calcium and stretch: T = s T_max.
struct PrescribedTension {
  double T_max = 0.0;  ///< [kPa]
};

/// The active law of a wall: one with kinetics, which goes by calcium, or one without.
using ActiveLaw = std::variant<NiedererHunterSmith, Land2017, PrescribedTension>;

}  // namespace lv::material
