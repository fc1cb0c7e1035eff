#pragma once

#include "lv/mesh/fibres.hpp"
#include "lv/mesh/shapes.hpp"

#include <span>
#include <vector>

namespace lv::mesh {

/// What the undeformed wall is at a point.
struct UndeformedPoint {
  Mat3 dX_dxi;
  double det;     ///< of dX/dxi, positive [mm^3]
  Vec3 X;         ///< [mm]
  double t;       ///< transmural coordinate
  double M;       ///< extent of the infarct, from 0 to 1 whatever the shapes do between the nodes
  WallAxes axes;  ///< circumferential, longitudinal, radial
  Mat3 frame;     ///< columns f0, s0, n0
};

/// Geometry and directions of the undeformed wall between its nodes, the same for both engines. The
/// radial direction is that of the transmural coordinate's own gradient in hexahedra; in
/// tetrahedra, where that may vanish, of radial_directions. The mesh must outlive it.
class UndeformedWall {
 public:
  explicit UndeformedWall(const Mesh& mesh);

  /// Throws InputError for an inverted or collapsed element, naming it.
  [[nodiscard]] UndeformedPoint at(const ElementPoint& point) const;

  /// The fibre frame at the centre of a cell, with the mean of grad t over it.
  [[nodiscard]] Mat3 frame_of_cell(int cell) const;

 private:
  [[nodiscard]] WallAxes axes(std::span<const int> nodes, std::span<const double> phi,
                              const Vec3& gradient_of_t) const;

  const Mesh& mesh_;
  std::vector<Vec3> radial_;  ///< per node of tetrahedra
};

}  // namespace lv::mesh
