#pragma once

namespace lv::material {

/// Tension at one point and how it changes with fibre stretch.
struct Tension {
  double value = 0.0;       ///< T [kPa]
  double derivative = 0.0;  ///< dT/dlambda [kPa]

  [[nodiscard]] friend Tension operator*(double factor, const Tension& T) {
    return {factor * T.value, factor * T.derivative};
  }
};

}  // namespace lv::material
