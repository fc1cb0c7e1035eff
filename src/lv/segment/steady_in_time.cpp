#include "lv/segment/steady_in_time.hpp"

#include "lv/base/median.hpp"

#include <algorithm>

namespace lv::segment {
namespace {

/// What is left of a correction of a radius beyond what the motion explains.
double unexplained(double correction, double motion) {
  constexpr double of_mean = 2.0;  // half of the wall moves, half does not
  const double explained = of_mean * motion;
  return explained < 0.0 ? correction - std::clamp(correction, explained, 0.0)
                         : correction - std::clamp(correction, 0.0, explained);
}

}  // namespace

std::vector<double> steady(const std::vector<double>& radius) {
  const std::size_t n = radius.size();
  std::vector<double> result;
  for (std::size_t t = 0; t < n; ++t) {
    const double r = radius[t];
    const double before = radius[(t + n - 1) % n];
    const double after = radius[(t + 1) % n];
    result.push_back(median({r, r, 2.0 * before - radius[(t + n - 2) % n],
                             2.0 * after - radius[(t + 2) % n], 0.5 * (before + after)}));
  }
  return result;
}

std::vector<double> shared_motion(const std::vector<std::vector<double>>& radii,
                                  std::size_t slice) {
  const std::size_t first = std::min(slice > 0 ? slice - 1 : 0, radii.size() - 3);
  std::vector<std::vector<double>> off;
  for (std::size_t s = first; s < first + 3; ++s) {
    off.push_back(steady(radii[s]));
    for (std::size_t t = 0; t < radii[s].size(); ++t)
      off.back()[t] -= radii[s][t];
  }
  std::vector<double> motion;
  for (std::size_t t = 0; t < radii[slice].size(); ++t)
    motion.push_back(median({off[0][t], off[1][t], off[2][t]}));
  return motion;
}

std::vector<Radii> steady_in_time(const std::vector<Radii>& lines,
                                  const std::vector<double>& motion) {
  std::vector<Radii> result(lines);
  std::vector<double> radius(lines.size());
  for (Eigen::Index i = 0; i < lines.front().size(); ++i) {
    for (std::size_t t = 0; t < lines.size(); ++t)
      radius[t] = lines[t](i);
    const std::vector<double> usual = steady(radius);
    for (std::size_t t = 0; t < lines.size(); ++t)
      result[t](i) = radius[t] + unexplained(usual[t] - radius[t], motion[t]);
  }
  return result;
}

}  // namespace lv::segment
