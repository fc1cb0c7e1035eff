#pragma once

#include "lv/implicit/reference_points.hpp"
#include "lv/mesh/quadratic.hpp"
#include "lv/solid/shape_table.hpp"

#include <Eigen/Core>

#include <vector>

/// Implicit equilibrium of the wall without inertia.
namespace lv::implicit {

/// The wall as finite elements of its mesh's order: displacement at the nodes, and the pressure
/// that keeps it incompressible (Q1/P0, Q2/P1 or P2/P1).
struct ReferenceWall {
  mesh::ElementNodes elements;   ///< of all ranks
  mesh::ElementNodes pressures;  ///< numbers of the pressure unknowns of each element
  int pressure_count = 0;
  solid::ShapeTable pressure_shapes;
  std::vector<int> owners;                 ///< the rank of each element
  std::vector<int> own;                    ///< this rank's elements
  std::vector<std::vector<Point>> points;  ///< of own
};

/// Throws InputError for an inverted or collapsed element, naming it, and for linear tetrahedra,
/// which lock.
[[nodiscard]] ReferenceWall reference_wall(const mesh::Mesh& mesh);

/// Whether det dX/dxi > 0 at all quadrature points. Every rank looks at the whole wall, so that all
/// agree.
[[nodiscard]] bool is_sound(const mesh::Mesh& mesh);

}  // namespace lv::implicit
