#include "lv/material/steady_tension.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lv::material {
namespace {

using Table = boost::math::interpolators::cardinal_quintic_b_spline<double>;

constexpr int intervals = 4096;
constexpr double tolerance = 1e-8;  ///< of the interpolated tension, relative

/// Where stretch_min = stretch_max the tension is the same at every stretch, and so may any step
/// be.
double step(const NiedererHunterSmith& law) {
  const double range = law.stretch_max - law.stretch_min;
  return range > 0.0 ? range / intervals : 1.0;
}

Table tabulate(const NiedererHunterSmith& law, double Ca) {
  std::vector<double> T;
  for (int i = 0; i <= intervals; ++i)
    T.push_back(law.steady_state(Ca, law.stretch_min + i * step(law)).tension);
  return {T, law.stretch_min, step(law)};
}

/// The error of interpolation is largest half-way between the tabulated stretches.
void check(const Table& table, const NiedererHunterSmith& law, double Ca) {
  for (int i = 0; i < intervals; ++i) {
    const double stretch = law.stretch_min + (i + 0.5) * step(law);
    const double T = law.steady_state(Ca, stretch).tension;
    if (std::abs(table(stretch) - T) > tolerance * std::abs(T))
      throw RunError(fmt::format("the steady active tension at a calcium of {:.4g} uM jumps, or is "
                                 "too steep to tabulate, near the stretch {:.4f}",
                                 Ca, stretch),
                     "Hold the calcium at another value: around this one the muscle has a weak and "
                     "a strong steady state");
  }
}

}  // namespace

SteadyTension::SteadyTension(const NiedererHunterSmith& law, double Ca)
    : table_(tabulate(law, Ca)),
      stretch_min_(law.stretch_min),
      stretch_max_(std::min(law.stretch_max, table_.t_max())) {  // the table's end is rounded
  check(table_, law, Ca);
}

double SteadyTension::tension(double stretch) const {
  return table_(std::clamp(stretch, stretch_min_, stretch_max_));
}

double SteadyTension::derivative(double stretch) const {
  const bool limited = stretch < stretch_min_ || stretch > stretch_max_;
  return limited ? 0.0 : table_.prime(stretch);
}

}  // namespace lv::material
