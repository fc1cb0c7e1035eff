#include "lv/material/calcium.hpp"

#include <cmath>

namespace lv::material {

double Calcium::at(double t) const {
  if (t <= 0.0)
    return Ca_0;
  if (mode == Mode::hold && t >= peak_time())
    return Ca_max;
  return Ca_0 + (Ca_max - Ca_0) * share(t);
}

double Calcium::peak_time() const {
  return shape == CurveShape::alpha_function ? tau : std::log(t_2 / t_1) / (1.0 / t_1 - 1.0 / t_2);
}

double Calcium::share(double t) const {
  if (shape == CurveShape::alpha_function)
    return (t / tau) * std::exp(1.0 - t / tau);
  const auto difference = [&](double s) { return std::exp(-s / t_2) - std::exp(-s / t_1); };
  return difference(t) / difference(peak_time());
}

}  // namespace lv::material
