#pragma once

#include "lv/mesh/mesh.hpp"

#include <array>
#include <vector>

/// Quadrature on the reference elements: unit square, cube, triangle and tetrahedron.
namespace lv::solid {

/// int f dxi = sum_q weight_q f(xi_q); the weights' sum is the reference element's size.
template <int Dim>
struct QuadraturePoint {
  std::array<double, Dim> xi;
  double weight;
};

/// The rule of displacements of that order, 1 or 2. Squares and cubes: order + 1 Gauss points in
/// each direction, the first running fastest, exact for degree 2 order + 1 in each. Triangles and
/// tetrahedra, all weights positive: for order 1 exact for degree 3 with 4 points (the Gauss-Jacobi
/// product of a triangle) and 6 (P. Keast, Comput. Methods Appl. Mech. Engng 55:339, 1986), for
/// order 2 exact for degree 5 with 7 points (J. Radon, Monatsh. Math. 52:286, 1948) and 14 (A.
/// Grundmann and H.M. Moeller, SIAM J. Numer. Anal. 15:282, 1978, as in N.J. Walkington, 2000).
template <int Dim>
[[nodiscard]] std::vector<QuadraturePoint<Dim>> quadrature(mesh::CellKind kind, int order);

}  // namespace lv::solid
