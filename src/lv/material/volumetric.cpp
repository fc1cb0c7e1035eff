#include "lv/material/volumetric.hpp"

#include "lv/material/tangent_algebra.hpp"

namespace lv::material {

Tangent<double> Volumetric::tangent(const Mat3& F) const {
  const Mat3 cof = cofactor(F);
  const double J = F.col(0).dot(cof.col(0));
  const double log_J = std::log(J);
  return 2.0 * beta_s / J * ((1.0 - log_J) / J * outer(cof, cof) + log_J * cofactor_tangent(F));
}

}  // namespace lv::material
