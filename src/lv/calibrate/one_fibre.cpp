#include "lv/calibrate/one_fibre.hpp"

#include <algorithm>
#include <cmath>

namespace lv::calibrate {

double one_fibre_volume(double V_0, double V_w, double stretch) {
  return std::max(0.0, V_w / 3.0 * (std::pow(stretch, 3) * (1.0 + 3.0 * V_0 / V_w) - 1.0));
}

}  // namespace lv::calibrate
