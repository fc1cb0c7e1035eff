#pragma once

namespace lv::solid {

/// What acts on the ventricle at one time.
struct Loads {
  double pressure = 0.0;    ///< in the cavity, a follower load on the endocardium [kPa]
  double activation = 0.0;  ///< share of the full activation: laws without kinetics go by it [-]
  double calcium = 0.0;     ///< laws with kinetics go by it [uM]

  [[nodiscard]] bool operator==(const Loads&) const = default;
};

}  // namespace lv::solid
