#include "lv/material/calcium.hpp"

#include <cmath>

namespace lv::material {

double Calcium::at(double t) const {
  if (t <= 0.0)
    return Ca_0;
  if (mode == Mode::hold && t >= tau)
    return Ca_max;
  return Ca_0 + (Ca_max - Ca_0) * (t / tau) * std::exp(1.0 - t / tau);
}

}  // namespace lv::material
