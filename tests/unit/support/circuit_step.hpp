#pragma once

#include "lv/circulation/circuit.hpp"
#include "lv/circulation/elastance.hpp"

namespace lv::test {

/// Advances a circuit by p.step to the time t [s] around an elastance for its left ventricle, whose
/// pressure is found as that of a wall is: Newton's method for V_circuit(p) = p/E + V_0.
inline void step(circulation::Circuit& circuit, const circulation::CircuitParameters& p, double t) {
  const circulation::Elastance ventricle(p.left_ventricle, p.period);
  const double E = ventricle.at(t);
  double pressure = ventricle.pressure(t, circuit.states().front());
  for (int k = 0; k < 50; ++k) {
    const auto [volume, slope] = circuit.after(t, p.step, pressure);
    pressure -= (volume - pressure / E - p.left_ventricle.V_0) / (slope - 1.0 / E);
  }
  circuit.advance(t, p.step, pressure);
}

}  // namespace lv::test
