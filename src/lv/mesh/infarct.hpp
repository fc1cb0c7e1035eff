#pragma once

#include "lv/mesh/mesh.hpp"
#include "lv/mesh/parameters.hpp"
#include "lv/mesh/regions.hpp"

#include <functional>
#include <vector>

/// The infarcted region U^in of section 2.2: a union of elements. An element belongs to it if its
/// centre does, so that engine, volumes and tables mean the same region.
namespace lv::mesh {

/// One flag per element.
using Infarcted = std::vector<bool>;

/// The elements whose centre (in the model frame) is inside.
[[nodiscard]] Infarcted infarcted_where(const Mesh& mesh,
                                        const std::function<bool(const Vec3&)>& inside);

/// The elements whose centre lies in an idealised infarct. With theta the angle about the cavity's
/// axis (see cavity_axis) from the sector's middle, h the height above the apex of the epicardium
/// over the wall's length, and t the transmural coordinate:
///
///   t <= transmurality  and  (h <= apex  or  (|theta| <= width / 2  and  bottom <= h <= top))
[[nodiscard]] Infarcted infarcted_as_described(const Mesh& mesh, const DescribedInfarct& infarct,
                                               const RegionParameters& regions);

/// The infarcted elements with those that they shut off: parts of the rest of the wall, hanging
/// together across faces, that are not its largest and reach neither epicardium nor base (the dark
/// core of a scar, where contrast agent does not come).
[[nodiscard]] Infarcted with_enclosed(const Mesh& mesh, const Infarcted& infarcted);

/// The extent of the infarct at every node, (2.11)-(2.12):
///
///   M = max(0, 1 - d / l),  d = min over X' in U^in of |X - X'|,  l the border zone's width [mm]
///
/// The distance is exact; at least one element must be infarcted.
[[nodiscard]] std::vector<double> infarct_field(const Mesh& mesh, const Infarcted& infarcted,
                                                double border);

/// Undeformed volumes [mm^3] of the wall, of the elements with M = 1 throughout, and of the border
/// zone: those with 0 < M < 1 somewhere.
struct InfarctVolumes {
  double wall = 0.0, infarct = 0.0, border = 0.0;
};
[[nodiscard]] InfarctVolumes infarct_volumes(const Mesh& mesh);

/// The infarct in one AHA segment.
struct SegmentInfarct {
  int segment = 0;       ///< 1 to 17
  double wall = 0.0;     ///< volume of the segment [mm^3]
  double infarct = 0.0;  ///< of its elements with M = 1 throughout [mm^3]
  /// Mean part of the wall's thickness that is infarcted where it is infarcted at all: over columns
  /// of the wall 5 mm high and 10 degrees wide, weighted by their volumes. 0 without infarct.
  double transmurality = 0.0;
};
[[nodiscard]] std::vector<SegmentInfarct> infarct_by_segment(const Mesh& mesh,
                                                             const Regions& regions,
                                                             const RegionParameters& parameters);

}  // namespace lv::mesh
