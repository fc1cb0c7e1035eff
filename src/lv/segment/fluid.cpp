#include "lv/segment/fluid.hpp"

#include "lv/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lv::segment {
namespace {

constexpr int least_side = 3;  // radii of a layer

/// What a split of a wall's grey values along a ray into an inner and an outer layer tells.
struct Layers {
  double step = 0.0;   ///< of the outer layer's mean from the inner one's
  double told = 0.0;   ///< part of the variance that the step is
  double slope = 0.0;  ///< of the outer layer's mean: its outer half's from its inner half's
};

using Row = Eigen::ArrayXd;

/// The split that tells most of the variance; none of a wall too thin for two layers.
std::optional<Layers> best_split(const Row& wall) {
  const Eigen::Index n = wall.size();
  if (n < 2 * least_side)
    return std::nullopt;
  const double all = (wall - wall.mean()).square().sum();
  Layers best;
  for (Eigen::Index inner = least_side; inner + least_side <= n; ++inner) {
    const Row outer = wall.tail(n - inner);
    const double step = outer.mean() - wall.head(inner).mean();
    const double between = step * step * static_cast<double>(inner) *
                           static_cast<double>(n - inner) / static_cast<double>(n);
    const double told = all > 0.0 ? between / all : 0.0;
    if (told <= best.told)
      continue;
    const Eigen::Index half = outer.size() / 2;
    best = {step, told, outer.tail(half).mean() - outer.head(half).mean()};
  }
  return best;
}

/// The layers of a ray in all frames in which its wall is thick enough.
std::vector<Layers> layers_along(const std::vector<Polar>& brightness,
                                 const std::vector<Radii>& endo, const std::vector<Radii>& epi,
                                 int ray, const PolarGrid& grid) {
  constexpr double margin = 1.5;  // blurred, at either border [mm]
  std::vector<Layers> layers;
  for (std::size_t t = 0; t < brightness.size(); ++t) {
    const int first = grid.index(endo[t](ray) + margin);
    const int last = grid.index(epi[t](ray) - margin);
    if (last <= first)
      continue;
    const Row wall = brightness[t].row(ray).segment(first, last - first + 1).transpose();
    if (const auto split = best_split(wall))
      layers.push_back(*split);
  }
  return layers;
}

double median_of(const std::vector<Layers>& layers, double Layers::*part) {
  std::vector<double> values;
  for (const Layers& l : layers)
    values.push_back(l.*part);
  return median(std::move(values));
}

}  // namespace

Radii fluid_within(const std::vector<Polar>& brightness, const std::vector<Radii>& endo,
                   const std::vector<Radii>& epi, const PolarGrid& grid) {
  constexpr double most_of_variance = 0.6;
  constexpr double even = 0.25;  // of the step
  const int beside = grid.rays / 36;
  std::vector<std::vector<Layers>> along;
  for (int i = 0; i < grid.rays; ++i)
    along.push_back(layers_along(brightness, endo, epi, i, grid));
  Radii fluid = Radii::Zero(grid.rays);
  for (int i = 0; i < grid.rays; ++i) {
    std::vector<Layers> near;
    for (int d = -beside; d <= beside; ++d) {
      const auto& own = along[static_cast<std::size_t>((i + d + grid.rays) % grid.rays)];
      near.insert(near.end(), own.begin(), own.end());
    }
    const auto looked_at = static_cast<std::size_t>(2 * beside + 1) * brightness.size();
    if (2 * near.size() < looked_at)
      continue;
    const double step = median_of(near, &Layers::step);
    if (step >= least_fluid && median_of(near, &Layers::told) >= most_of_variance &&
        std::abs(median_of(near, &Layers::slope)) <= even * step)
      fluid(i) = step;
  }
  return fluid;
}

}  // namespace lv::segment
