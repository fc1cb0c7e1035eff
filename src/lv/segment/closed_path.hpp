#pragma once

#include "lv/segment/polar.hpp"

#include <vector>

namespace lv::segment {

/// How a path may run from ray to ray.
struct PathRule {
  int reach = 1;           ///< largest change of the radius' number between neighbouring rays
  double stiffness = 0.1;  ///< cost of a change by one; grows with its square
};

/// The closed path, one radius k_i per ray, that makes
///
///   sum_i cost(i, k_i) + stiffness (k_i - k_(i-1))^2,    |k_i - k_(i-1)| <= reach,
///
/// least, ray 0 following the last. By dynamic programming from each start that an open path, whose
/// cost is a lower bound, leaves a chance to be best. The costs must be finite.
[[nodiscard]] std::vector<int> closed_path(const Polar& cost, const PathRule& rule);

/// The open path of least cost, from the first ray to the last, under the same rule.
[[nodiscard]] std::vector<int> open_path(const Polar& cost, const PathRule& rule);

/// A radius, by its number, that a path has on a ray.
struct Fixed {
  int ray = 0, k = 0;
};

/// The same through given radii, one per ray at most. The reach grows to what the steepest way from
/// one to the next needs.
[[nodiscard]] std::vector<int> closed_path(Polar cost, PathRule rule,
                                           const std::vector<Fixed>& fixed);

/// The same in mm.
[[nodiscard]] Radii closed_path(const Polar& cost, const PathRule& rule, const PolarGrid& grid,
                                const std::vector<Fixed>& fixed = {});

}  // namespace lv::segment
