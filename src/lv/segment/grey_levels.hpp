#pragma once

#include "lv/segment/polar.hpp"

#include <vector>

namespace lv::segment {

/// Part of the cavity's radius within which all is blood, but for papillary muscles.
constexpr double surely_blood = 0.5;

/// The grey values of blood in a slice and of muscle along each ray.
struct Levels {
  double blood = 1.0;
  Radii muscle;
  double muscle_of_slice = 0.0;  ///< 0: not known yet
  Radii fluid = {};              ///< outside the muscle (see fluid_within); empty: not looked for
};

/// Blood: the median within half of the cavity's radius over all frames. Muscle, not known yet:
/// 0.35 of it, as usual in balanced steady-state images.
[[nodiscard]] Levels guess_levels(const std::vector<Polar>& frames, double radius,
                                  const PolarGrid& grid);

/// The same of blood while a slice holds most of it: the upper quartile over the frames of what
/// each shows. The tip comes and goes; a cavity that ends in a slice at end-systole may be half of
/// its thickness deep at end-diastole.
[[nodiscard]] double fullest_blood(const std::vector<Polar>& frames, double radius,
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

/// The blood's grey value of each slice: that inside the cavity, but not less than the lower
/// quartile of the study's ratios of blood to muscle makes of the slice's muscle. Where the tip
/// ends in a slice, muscle makes all that is inside darker; coils change blood and muscle alike.
[[nodiscard]] std::vector<double> whole_blood(const std::vector<double>& inside,
                                              const std::vector<double>& muscle);

/// The grey values of a study's blood b and muscle m (medians over its slices).
struct Contrast {
  double blood = 1.0;
  double muscle = 0.0;
};

[[nodiscard]] Contrast contrast_of(const std::vector<double>& muscle,
                                   const std::vector<double>& blood);

/// What an image would show where it shows v if muscle were m' = 0.28 of the blood, as in the
/// patients' images with which the numbers of this room were chosen (0.28 and 0.30): sequences, and
/// scanners that raise the dark end, make it up to half as bright. Above m the way to blood stays
/// as it is, since an edge in a voxel mixes signals: v -> m' + (v - m)(b - m')/(b - m); below,
/// where lung and the lines between organs are, v -> m' (v/m)^g, g = ln(m'/b)/ln(m/b). Darker
/// muscle is left as it is: dark lines would become fainter.
[[nodiscard]] double with_usual_contrast(double value, const Contrast& contrast);

/// The muscle's grey value along each ray before the wall is known: the most frequent one outside
/// the blood within 30 degrees, over all frames, between 0.4 and 1.6 of the slice's own, which
/// stands where there is none; of these the mean and two harmonics, since the coils' sensitivity is
/// smooth.
[[nodiscard]] Radii muscle_round(const std::vector<Polar>& frames, const std::vector<Radii>& blood,
                                 double of_slice, const PolarGrid& grid);

/// The muscle's grey value along each ray: the median over time within 1.6 mm of the middle of the
/// wall, between 0.65 and 1.5 of the usual one, smoothed over rays (15 degrees).
[[nodiscard]] Radii muscle_along(const std::vector<Polar>& frames, const std::vector<Radii>& middle,
                                 const Radii& usual, const PolarGrid& grid);

}  // namespace lv::segment
