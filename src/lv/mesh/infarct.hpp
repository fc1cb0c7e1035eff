#pragma once

#include "lv/mesh/mesh.hpp"
#include "lv/mesh/parameters.hpp"
#include "lv/mesh/regions.hpp"

#include <functional>
#include <vector>

/// The infarcted region U^in of section 2.2. For the mechanics it is a union of elements, those
/// whose centre is infarcted. Volumes and tables count the part of every element that is: elements
/// are layered through the wall, and a layer is in or out as a whole.
namespace lv::mesh {

/// One flag per element.
using Infarcted = std::vector<bool>;

/// Whether the wall is infarcted at X (in the model frame), at depth t.
using Region = std::function<bool(const Vec3& X, double t)>;

/// The elements whose centre is inside.
[[nodiscard]] Infarcted infarcted_where(const Mesh& mesh, const Region& inside);

/// The part of every element that is inside, from points spread over it (see spread_points).
[[nodiscard]] std::vector<double> infarcted_part(const Mesh& mesh, const Region& inside);

/// An idealised infarct. With theta the angle about the cavity's axis (see cavity_axis) from the
/// sector's middle, h the height above the apex of the epicardium over the wall's length, and t the
/// transmural coordinate:
///
///   t <= transmurality  and  (h <= apex  or  (|theta| <= width / 2  and  bottom <= h <= top))
[[nodiscard]] Region described_region(const Mesh& mesh, const DescribedInfarct& infarct,
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

/// 1 for elements with M = 1 at all nodes, else 0: for an infarct that is given by M alone.
[[nodiscard]] std::vector<double> part_by_extent(const Mesh& mesh);

/// Undeformed volumes [mm^3] of the wall, of the infarcted parts of its elements, and of the border
/// zone: what is not infarcted of the elements with M > 0 somewhere.
struct InfarctVolumes {
  double wall = 0.0, infarct = 0.0, border = 0.0;
};
[[nodiscard]] InfarctVolumes infarct_volumes(const Mesh& mesh, const std::vector<double>& part);

/// The infarct in one AHA segment.
struct SegmentInfarct {
  int segment = 0;       ///< 1 to 17
  double wall = 0.0;     ///< volume of the segment [mm^3]
  double infarct = 0.0;  ///< of the infarcted parts of its elements [mm^3]
  /// Mean part of the wall's thickness that is infarcted where it is infarcted at all: infarcted
  /// volume over the volume of what columns of the wall have of it along the wall. Columns are 5 mm
  /// high and 5 mm/30 mm (10 degrees) wide, or two elements each way; of one that is infarcted at
  /// several depths the part of its cross-section counts that is infarcted there, of others all,
  /// where they hold most of the infarct. 0 without infarct.
  double transmurality = 0.0;
};
[[nodiscard]] std::vector<SegmentInfarct> infarct_by_segment(const Mesh& mesh,
                                                             const std::vector<double>& part,
                                                             const Regions& regions,
                                                             const RegionParameters& parameters);

}  // namespace lv::mesh
