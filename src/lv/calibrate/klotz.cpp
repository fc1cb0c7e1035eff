#include "lv/calibrate/klotz.hpp"

#include "lv/base/units.hpp"

#include <cmath>

namespace lv::calibrate {
namespace {

using units::ml;
using units::mmHg;
constexpr double A_n = 27.78;  // [mmHg]
constexpr double B_n = 2.76;

}  // namespace

double Klotz::pressure(double V) const {
  return alpha * std::pow(V / ml, beta) * mmHg;
}

double Klotz::volume(double P) const {
  return std::pow(P / mmHg / alpha, 1.0 / beta) * ml;
}

Klotz klotz(double V_m, double P_m) {
  const double P = P_m / mmHg;
  Klotz k;
  k.V0 = V_m * (0.6 - 0.006 * P);
  k.V30 = k.V0 + (V_m - k.V0) / std::pow(P / A_n, 1.0 / B_n);
  if (P <= 22.0) {
    k.beta = std::log(P / 30.0) / std::log(V_m / k.V30);
    k.alpha = 30.0 / std::pow(k.V30 / ml, k.beta);
  } else {
    const double V15 = k.V0 + 0.8 * (k.V30 - k.V0);
    k.beta = std::log(P / 15.0) / std::log(V_m / V15);
    k.alpha = P / std::pow(V_m / ml, k.beta);
  }
  return k;
}

double klotz_filling(double pressure_ratio) {
  return std::pow(pressure_ratio, 1.0 / B_n);
}

}  // namespace lv::calibrate
