#pragma once

#include "lv/mesh/mesh.hpp"

#include <array>
#include <span>
#include <vector>

/// The shape functions of all finite elements and of their sides: Lagrange polynomials on the unit
/// square and cube and on the unit triangle and tetrahedron.
namespace lv::mesh {

/// phi_a and d phi_a/d xi_d of N nodes at a place of the reference element.
template <int N, int Dim>
struct ShapesAt {
  std::array<double, N> value{};
  std::array<std::array<double, Dim>, N> gradient{};
};

/// The polynomials on the nodes 0, (1/2), 1 of a line, and their slopes.
template <int Order>
struct LineShapes {
  std::array<double, Order + 1> value, slope;

  constexpr explicit LineShapes(double x) {
    if constexpr (Order == 1) {
      value = {1.0 - x, x};
      slope = {-1.0, 1.0};
    } else {
      value = {(1.0 - x) * (1.0 - 2.0 * x), 4.0 * x * (1.0 - x), x * (2.0 * x - 1.0)};
      slope = {4.0 * x - 3.0, 4.0 - 8.0 * x, 4.0 * x - 1.0};
    }
  }
};

/// Quadrilateral or hexahedron: the (Order + 1)^Dim lattice, the first direction running fastest.
template <int Order, int Dim>
constexpr auto lattice_shapes(const std::array<double, Dim>& xi) {
  constexpr int n = Order + 1;
  ShapesAt<Dim == 2 ? n * n : n * n * n, Dim> s;
  for (int a = 0; a < static_cast<int>(s.value.size()); ++a) {
    s.value[a] = 1.0;
    s.gradient[a].fill(1.0);
    for (int d = 0, place = a; d < Dim; ++d, place /= n) {
      const LineShapes<Order> line(xi[d]);
      s.value[a] *= line.value[place % n];
      for (int e = 0; e < Dim; ++e)
        s.gradient[a][e] *= e == d ? line.slope[place % n] : line.value[place % n];
    }
  }
  return s;
}

/// The edges of a triangle (the first three) and a tetrahedron in the order of their middles.
inline constexpr std::array<std::array<int, 2>, 6> simplex_edges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// Triangle or tetrahedron: the corners, then the middles of simplex_edges.
template <int Order, int Dim>
constexpr auto simplex_shapes(const std::array<double, Dim>& xi) {
  constexpr int corners = Dim + 1;
  constexpr int edges = Order == 1 ? 0 : Dim == 2 ? 3 : 6;
  ShapesAt<corners, Dim> linear;
  linear.value[0] = 1.0;
  linear.gradient[0].fill(-1.0);
  for (int d = 0; d < Dim; ++d) {
    linear.value[0] -= xi[d];
    linear.value[d + 1] = xi[d];
    linear.gradient[d + 1][d] = 1.0;
  }
  if constexpr (Order == 1) {
    return linear;
  } else {
    ShapesAt<corners + edges, Dim> s;
    const auto& L = linear.value;
    const auto& dL = linear.gradient;
    for (int a = 0; a < corners; ++a) {
      s.value[a] = L[a] * (2.0 * L[a] - 1.0);
      for (int d = 0; d < Dim; ++d)
        s.gradient[a][d] = (4.0 * L[a] - 1.0) * dL[a][d];
    }
    for (int e = 0; e < edges; ++e) {
      const auto [a, b] = simplex_edges[e];
      s.value[corners + e] = 4.0 * L[a] * L[b];
      for (int d = 0; d < Dim; ++d)
        s.gradient[corners + e][d] = 4.0 * (L[a] * dL[b][d] + L[b] * dL[a][d]);
    }
    return s;
  }
}

/// VTK's order of a hexahedron's corners by lattice place, and the other way round.
inline constexpr std::array<int, 8> hexahedron_corner{0, 1, 3, 2, 4, 5, 7, 6};

/// Where corner a of a hexahedron in VTK's order lies in the unit cube, 0 or 1 along direction d.
constexpr int corner_place(int a, int d) {
  return (hexahedron_corner[a] >> d) & 1;
}

/// Linear hexahedron with its corners in VTK's order.
constexpr ShapesAt<8, 3> hexahedron_shapes(const std::array<double, 3>& xi) {
  const ShapesAt<8, 3> lattice = lattice_shapes<1, 3>(xi);
  ShapesAt<8, 3> s;
  for (int a = 0; a < 8; ++a) {
    s.value[a] = lattice.value[hexahedron_corner[a]];
    s.gradient[a] = lattice.gradient[hexahedron_corner[a]];
  }
  return s;
}

/// The shapes of an element (Dim 3, nodes in the order of mesh::elements) or of a side (Dim 2,
/// mesh::sides), gradients Dim x nodes.
struct Shapes {
  Eigen::VectorXd value;
  Eigen::MatrixXd gradient;
};
template <int Dim>
[[nodiscard]] Shapes shapes(CellKind kind, int order, const std::array<double, Dim>& xi);

/// A point of an element of any order: the element's nodes, and its shapes there.
struct ElementPoint {
  int cell = 0;  ///< of the mesh: the element, or its first part
  std::span<const int> nodes;
  std::span<const double> phi;       ///< phi_a of each node
  std::span<const double> gradient;  ///< d phi_a/d xi_d, three numbers for each node
};

/// The point of a mesh's cell that these shapes are of.
template <int N>
[[nodiscard]] ElementPoint point_of(const Mesh& mesh, int cell, const ShapesAt<N, 3>& shapes) {
  return {cell, mesh.cell(cell), shapes.value, {shapes.gradient.front().data(), 3 * N}};
}

/// dX/dxi of an element at a point.
[[nodiscard]] Mat3 jacobian(const Mesh& mesh, const ElementPoint& point);

/// Where an element's nodes lie in the reference element, in the order of mesh::elements.
[[nodiscard]] std::vector<Vec3> node_places(CellKind kind, int order);

}  // namespace lv::mesh
