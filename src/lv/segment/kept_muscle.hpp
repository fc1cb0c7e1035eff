#pragma once

#include "lv/segment/polar.hpp"

#include <vector>

/// What a slice holds besides blood, given that muscle keeps its volume.
///
/// Within the epicardium all that is not blood counts: the wall, papillary muscles and trabeculae.
/// Trabeculae close while the ventricle empties and count as wall then, so that the wall alone, as
/// it is drawn, keeps no volume. Images stand still while the axis shortens, so that each slice
/// holds a little more then: as much as the same muscle grows across the axis.
namespace lv::segment {

/// Areas [mm^2] of slices, each over the frames.
using Areas = std::vector<std::vector<double>>;

/// The area within a line that is not blood [mm^2], a place by its darkness: 0 blood, 1 muscle.
[[nodiscard]] double dark_area(const Polar& darkness, const Radii& line, const PolarGrid& grid);

/// The line outside the endocardium, as far as a multiple of the wall's thickness along each ray
/// (0.3 to 3), within which an area is not blood.
[[nodiscard]] Radii line_that_holds(const Polar& darkness, const Radii& endo,
                                    const Radii& thickness, double dark, const PolarGrid& grid);

/// What slices hold in each frame if their muscle keeps its volume, and how far that can be
/// believed.
struct Kept {
  Areas areas;
  std::vector<double> agreement;  ///< of each slice with the others, 0 to 1
};

/// The dark areas of slices that keep their muscle, from those that they hold, and the areas
/// within the middle of the wall.
///
/// What a slice holds is taken for the product of its own area and what all slices do in a frame
/// (medians in turn, of logarithms). The latter stays between what it is at end-diastole, when the
/// middle of the wall is widest (the median of the frames that are within 2% of its radius there),
/// and as much more as the middle of the wall has become shorter: along the axis hearts shorten by
/// no larger part than round it.
///
/// A slice agrees while it strays from that product (the median of its frames) by no more than the
/// median slice does or than 3%, as exactly as lines are drawn, and by the square of the ratio
/// where it strays farther: the base and the tip pass through slices at the ends, and take muscle
/// with them. A slice that stands off in single frames agrees: there its border is wrong.
[[nodiscard]] Kept kept_areas(const Areas& held, const Areas& within_middle);

}  // namespace lv::segment
