#include "lv/material/land2017.hpp"

#include "lv/base/dual.hpp"

namespace lv::material {

Tension Land2017::steady_tension(double Ca, double stretch) const {
  const Dual<1> T = steady_state(Ca, Dual<1>::variable(stretch)).tension;
  return {T.value, T.slope[0]};
}

}  // namespace lv::material
