#include "lv/segment/edge_width.hpp"

#include "lv/base/median.hpp"

#include <algorithm>
#include <cmath>

namespace lv::segment {
namespace {

/// Phi^-1(edge_ends) - Phi^-1(edge_begins): the width of an edge that is as wide as the point
/// spread, in its deviations.
constexpr double of_point_spread = 1.0364;

double normal_density(double x) {
  return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
}

double normal_below(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

/// D(x) of a ramp of the width d, lengths in deviations of the point spread:
/// ((x + d) Phi(x + d) + phi(x + d) - x Phi(x) - phi(x))/d.
double ramp(double x, double d) {
  const auto integral = [](double y) { return y * normal_below(y) + normal_density(y); };
  return (integral(x + d) - integral(x)) / d;
}

/// Where a growing function reaches a value.
template <class Function>
double where(const Function& f, double value, double low, double high) {
  constexpr int halvings = 40;
  for (int n = 0; n < halvings; ++n) {
    const double middle = 0.5 * (low + high);
    (f(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The width of a ramp's edge as a multiple of the point spread's.
double relative_width(double d) {
  const auto at = [&](double darkness) {
    return where([&](double x) { return ramp(x, d); }, darkness, -d - 6.0, 6.0);
  };
  return (at(edge_ends) - at(edge_begins)) / of_point_spread;
}

/// The darkness at the outer end of a ramp whose edge is so many times as wide as a sharp one.
double darkness_beyond_ramp(double width) {
  constexpr double unsure = 0.2;   // of the variance
  constexpr double widest = 20.0;  // ramp, in deviations of the point spread
  constexpr double most = 0.95;    // nearer to muscle its own texture would decide
  const double beyond = width * width - 1.0 - unsure;
  if (beyond <= 0.0)
    return edge_begins;
  return std::min(most, ramp(0.0, where(relative_width, std::sqrt(1.0 + beyond), 1e-3, widest)));
}

/// Where darkness falls below a level, inwards from radius k, as a number of radii; negative if it
/// does not.
double falls_below(const Polar& darkness, Eigen::Index ray, Eigen::Index k, double level) {
  while (k >= 0 && darkness(ray, k) >= level)
    --k;
  if (k < 0)
    return -1.0;
  const double inner = darkness(ray, k);
  return static_cast<double>(k) + (level - inner) / (darkness(ray, k + 1) - inner);
}

}  // namespace

Radii edge_widths(const Polar& darkness, const Radii& wall, const PolarGrid& grid) {
  Radii widths = Radii::Constant(grid.rays, -1.0);
  for (int i = 0; i < grid.rays; ++i) {
    const int from = grid.index(wall(i));
    if (darkness(i, from) < edge_ends)
      continue;
    const double outer = falls_below(darkness, i, from, edge_ends);
    const double inner = falls_below(darkness, i, static_cast<Eigen::Index>(outer), edge_begins);
    if (outer >= 0.0 && inner >= 0.0)
      widths(i) = grid.step * (outer - inner);
  }
  return widths;
}

double sharp_width(const image::Plane& plane, const PolarGrid& grid, double slope, double spacing) {
  const double pixel = plane.spacing_i * plane.spacing_j;
  const double lean = slope * spacing;
  return of_point_spread *
         std::sqrt(pixel / 12.0 + pixel / 6.0 + 0.5 * grid.step * grid.step + lean * lean / 12.0);
}

BorderDarkness darkness_at_border(std::vector<double> widths) {
  constexpr double sharpest = 0.77;  // tenth, as a part of the median
  if (widths.empty())
    return {};
  const auto tenth = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 10);
  std::nth_element(widths.begin(), tenth, widths.end());
  const double sharp = std::max(1.0, *tenth / sharpest);
  const double width = median(std::move(widths));
  return {darkness_beyond_ramp(width / sharp), darkness_beyond_ramp(width)};
}

}  // namespace lv::segment
