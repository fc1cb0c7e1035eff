#include "lv/segment/ring.hpp"

namespace lv::segment {
namespace {

/// The end of the first dark layer along a ray that ends before `border` [mm]; none: negative.
double layer_before(const Polar& darkness, int ray, double border, const PolarGrid& grid) {
  constexpr double dark = 0.5;
  constexpr double deep = 4.0;    // [mm]
  constexpr double before = 1.0;  // [mm]
  int first = 0;
  for (int k = 0; k < grid.radii && grid.radius(k) <= border - before; ++k) {
    if (darkness(ray, k) > dark)
      continue;
    if (grid.step * (k - first) >= deep)
      return grid.radius(k);
    first = k + 1;
  }
  return -1.0;
}

}  // namespace

std::optional<Radii> ring_within(const Polar& darkness, const Radii& border,
                                 const PolarGrid& grid) {
  constexpr double least_part = 0.75;  // of the circumference
  Radii ends = Radii::Constant(grid.rays, grid.last());
  int layers = 0;
  for (int i = 0; i < grid.rays; ++i)
    if (const double end = layer_before(darkness, i, border(i), grid); end > 0.0) {
      ends(i) = end;
      ++layers;
    }
  if (layers < least_part * grid.rays)
    return std::nullopt;
  return ends;
}

Radii path_within_ring(const Polar& cost, const Polar& darkness, double beyond,
                       const PathRule& rule, const PolarGrid& grid,
                       const std::vector<Fixed>& fixed) {
  Radii path = closed_path(cost, rule, grid, fixed);
  const auto ring = ring_within(darkness, path, grid);
  if (!ring)
    return path;
  const Polar outside = (distance_from(*ring, grid) > 0.0).cast<double>();
  return closed_path(cost + beyond * outside, rule, grid, fixed);
}

}  // namespace lv::segment
