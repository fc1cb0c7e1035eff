#include "lv/material/neo_hookean.hpp"

#include "lv/material/tangent_algebra.hpp"

namespace lv::material {

Tangent<double> NeoHookean::tangent(const Mat3& F) const {
  const Mat3 G = cofactor(F) / determinant(F);
  return mu * (Tangent<double>::Identity() - inverse_transpose_tangent(G));
}

}  // namespace lv::material
