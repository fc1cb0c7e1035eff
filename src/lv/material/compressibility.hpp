#pragma once

#include <cmath>
#include <limits>

namespace lv::material {

/// Resistance to changes of volume with the energy of Arostica et al. 2025, in the form that a
/// mixed method needs, J as a function of the tension p that goes with it:
///
///   U(J) = kappa/4 (J^2 - 1 - 2 ln J),  p = dU/dJ = kappa/2 (J - 1/J)                    [kPa]
///   J(p) = p/kappa + sqrt(1 + (p/kappa)^2)                                               [-]
///
/// Without a finite kappa J = 1.
struct Compressibility {
  double kappa = std::numeric_limits<double>::infinity();  ///< bulk modulus [kPa]

  [[nodiscard]] double J(double p) const {
    const double x = p / kappa;
    return x + std::sqrt(1.0 + x * x);
  }

  /// dJ/dp [1/kPa].
  [[nodiscard]] double slope(double p) const {
    const double x = p / kappa;
    return J(p) / (kappa * std::sqrt(1.0 + x * x));
  }

  /// U(J(p)) [kPa].
  [[nodiscard]] double energy(double p) const {
    if (std::isinf(kappa))
      return 0.0;
    const double j = J(p);
    return 0.25 * kappa * (j * j - 1.0 - 2.0 * std::log(j));
  }
};

}  // namespace lv::material
