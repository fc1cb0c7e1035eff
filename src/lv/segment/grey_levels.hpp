#pragma once

#include "lv/segment/polar.hpp"

#include <vector>

namespace lv::segment {

/// The grey values of blood in a slice and of muscle along each ray.
struct Levels {
  double blood = 1.0;
  Radii muscle;
};

/// Blood: the median within half of the cavity's radius over all frames. Muscle, not known yet:
/// 0.35 of it, as usual in balanced steady-state images.
[[nodiscard]] Levels guess_levels(const std::vector<Polar>& frames, double radius,
                                  const PolarGrid& grid);

/// The grey values 2 to 10 mm outside the blood.
[[nodiscard]] std::vector<double> around_blood(const std::vector<Polar>& frames,
                                               const std::vector<Radii>& blood,
                                               const PolarGrid& grid);

/// The muscle's grey value of each slice: the most frequent one of the study between a tenth and
/// six tenths of the blood's, then the most frequent one of the slice within a third of that, the
/// median with its neighbours. `outside` and `blood` are those of the slices.
[[nodiscard]] std::vector<double> muscle_levels(const std::vector<std::vector<double>>& outside,
                                                const std::vector<double>& blood);

/// The muscle's grey value along each ray: the median over time within 1.6 mm of the middle of the
/// wall, between 0.65 and 1.5 of the slice's own, smoothed over rays (15 degrees).
[[nodiscard]] Radii muscle_along(const std::vector<Polar>& frames, const std::vector<Radii>& middle,
                                 double of_slice, const PolarGrid& grid);

}  // namespace lv::segment
