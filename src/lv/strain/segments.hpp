#pragma once

#include "lv/base/table.hpp"
#include "lv/strain/ring.hpp"

#include <string>
#include <vector>

namespace lv::strain {

/// A slice over the cycle.
struct SliceSeries {
  int slice = 0;                    ///< its number
  int third = 0;                    ///< 0 basal, 1 middle, 2 apical third of the cavity's length
  std::vector<int> phases;          ///< numbers of the images, from 1, in order of time
  std::vector<double> times;        ///< after the R wave [s]; empty if not known
  std::vector<SliceMotion> motion;  ///< one per phase
};

/// Strain of a region at one phase.
struct SegmentStrain {
  std::string scheme;  ///< slice, sector (the paper's six), aha17 or whole
  int slice = 0;       ///< 0 unless the region belongs to one
  std::string segment;
  int phase = 0;
  double time = 0.0;  ///< NaN if not known
  RingStrain strain;
};

/// The paper's six sectors of every slice and the slice itself, the 16 AHA segments that lie on
/// short-axis slices, and the wall as a whole, at every phase. A region of several slices takes
/// their rays together; it has the phases that all of them have.
[[nodiscard]] std::vector<SegmentStrain> segments(const std::vector<SliceSeries>& slices);

/// Columns: scheme, slice, segment, phase, time_s, circumferential_strain, radial_strain (both
/// Green-Lagrange), circumferential_shortening, wall_thickening (both length / length at
/// end-diastole - 1).
[[nodiscard]] Table segments_table(const std::vector<SegmentStrain>& rows);

/// Columns: slice, phase, time_s, rotation_deg, anticlockwise seen from the apex positive.
[[nodiscard]] Table rotation_table(const std::vector<SliceSeries>& slices);

}  // namespace lv::strain
