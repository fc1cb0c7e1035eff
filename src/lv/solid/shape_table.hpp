#pragma once

#include "lv/mesh/mesh.hpp"

#include <Eigen/Core>

#include <vector>

/// Finite elements of any kind and order, as tables of their shape functions.
namespace lv::solid {

/// Shape functions phi_a and their gradients at the quadrature points of a reference element.
struct ShapeTable {
  Eigen::VectorXd weight;                 ///< per point; their sum is the reference element's size
  Eigen::MatrixXd value;                  ///< phi_a(xi_q), points x nodes
  std::vector<Eigen::MatrixXd> gradient;  ///< per point, d phi_a/d xi_d, dimension x nodes

  [[nodiscard]] int points() const { return static_cast<int>(weight.size()); }
  [[nodiscard]] int nodes() const { return static_cast<int>(value.cols()); }
};

/// Places in a reference element and the weights of a rule that has them as its points.
struct ReferencePoints {
  std::vector<Vec3> places;
  std::vector<double> weights;
};

/// The displacement of hexahedra (order + 1 Gauss points in each direction) or tetrahedra (a rule
/// exact for degree 3 at least), with nodes in the order of mesh::elements.
[[nodiscard]] ShapeTable element_shapes(mesh::CellKind kind, int order);

/// The same for the sides of those elements, with nodes in the order of mesh::sides.
[[nodiscard]] ShapeTable side_shapes(mesh::CellKind kind, int order);

/// The pressure that goes with the displacement, at the points of element_shapes; without
/// gradients. Hexahedra: polynomials of degree order - 1, free to jump between elements (constant,
/// or linear: Q2/P1). Quadratic tetrahedra: linear and continuous, one value per corner
/// (Taylor-Hood).
[[nodiscard]] ShapeTable pressure_shapes(mesh::CellKind kind, int order);

/// Displacement and pressure at other points of the reference element.
[[nodiscard]] ShapeTable element_shapes(mesh::CellKind kind, int order,
                                        const ReferencePoints& points);
[[nodiscard]] ShapeTable pressure_shapes(mesh::CellKind kind, int order,
                                         const ReferencePoints& points);

}  // namespace lv::solid
