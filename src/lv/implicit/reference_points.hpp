#pragma once

#include "lv/mesh/undeformed_wall.hpp"
#include "lv/solid/shape_table.hpp"

#include <vector>

namespace lv::implicit {

/// What the equations need of the undeformed wall at one quadrature point.
struct Point {
  Eigen::Matrix3Xd
      gradient;         ///< d phi_a/dX in the fibre frame, 3 x nodes: F' = sum_a x_a (x) gradient_a
  double volume = 0.0;  ///< [mm^3]
  double infarct = 0.0;  ///< M
};

/// Makes the points of one element after the other. The mesh must outlive it.
class PointMaker {
 public:
  explicit PointMaker(const mesh::Mesh& mesh) : undeformed_(mesh) {}

  /// The points of a table of an element's shapes; the element has these nodes, and `cell` is its
  /// first part. Throws InputError for an inverted or collapsed element, naming it.
  [[nodiscard]] std::vector<Point> points(const solid::ShapeTable& shapes, int cell,
                                          std::span<const int> nodes) const;

 private:
  mesh::UndeformedWall undeformed_;
};

}  // namespace lv::implicit
