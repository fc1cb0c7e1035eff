#pragma once

#include "lv/mesh/mesh.hpp"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace lv::mesh {

struct RegionParameters {
  double septum_angle =
      0.0;  ///< direction of the middle of the septum about the long axis, from x towards y [rad]
  double slice_spacing = 0.0;  ///< between the seven slice planes [mm]; 0: the wall's length / 6.5,
                               ///< so that the apex is half a spacing beyond the seventh
};

/// The paper's division (section 2.2, Fig. 3): seven short-axis planes from the base on, five with
/// six sectors and two with four; every point belongs to the plane nearest to it. And the 17
/// segments of the American Heart Association: basal, middle and apical thirds of the cavity's
/// length, and the apex beyond the cavity.
///
/// Sectors are counted about the centre of the cavity in their slice (a third for the AHA's), as on
/// an image: the long axis of a real ventricle is bent. They are named for a heart with the septum
/// at `septum_angle` and the anterior wall 90 degrees further, anticlockwise seen from the base.
struct Regions {
  std::vector<int> slice;   ///< per cell: 1 (base) to 7 (apex)
  std::vector<int> sector;  ///< per cell: 1-6 ant antsept infsept inf inflat antlat; in slices 6,
                            ///< 7: 1-4 ant sept inf lat
  std::vector<int> aha;     ///< per cell: 1 to 17
};

inline constexpr int slice_count = 7;

/// Sectors in a slice, 1 to 7.
[[nodiscard]] constexpr int sectors_of_slice(int slice) {
  return slice <= 5 ? 6 : 4;
}

/// The line about which sectors are counted, as a function of z: through the middles of the cavity
/// near the seven planes, straight between them.
[[nodiscard]] std::function<Vec3(double z)> cavity_axis(const Mesh& mesh,
                                                        const RegionParameters& parameters);

[[nodiscard]] Regions divide(const Mesh& mesh, const RegionParameters& parameters);

/// The sector, 1 to `sectors`, that holds an angle: sector 1 (anterior) has its middle a quarter
/// turn beyond the septum's angle, the next ones follow clockwise seen from the base [rad].
[[nodiscard]] int sector_at(double angle, double septum_angle, int sectors);

inline constexpr int aha_count = 17;

/// A factor of each AHA segment.
using SegmentFactors = std::array<double, aha_count>;

[[nodiscard]] constexpr SegmentFactors even_segments() {
  SegmentFactors factors{};
  factors.fill(1.0);
  return factors;
}

/// At every node the mean of the factors of the cells around it, between which the elements
/// interpolate; empty where all are 1 or the mesh has no segments.
[[nodiscard]] std::vector<double> at_nodes(const Mesh& mesh, const SegmentFactors& factors);

/// "ant", "antsept", ... of a sector of a slice.
[[nodiscard]] std::string sector_name(int slice, int sector);

/// "basal anterior", ... of an AHA segment.
[[nodiscard]] std::string aha_name(int segment);

/// The sides of elements on the epicardium that the right ventricle's blood touches, between its
/// insertions: those of the septal AHA segments 2, 3, 8, 9 and 14, by at least half of their faces.
/// None of a mesh without segments.
[[nodiscard]] Surface septum(const Mesh& mesh);

}  // namespace lv::mesh
