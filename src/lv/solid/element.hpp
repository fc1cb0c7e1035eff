#pragma once

#include "lv/mesh/gauss.hpp"
#include "lv/mesh/shapes.hpp"

#include <array>

namespace lv::solid {

/// An element's shape functions at its quadrature points: `gradient[q][a]` for point q and node a;
/// `weight[q]` of point q.
template <int Points, int Nodes>
struct Quadrature {
  std::array<std::array<std::array<double, 3>, Nodes>, Points> gradient{};
  std::array<std::array<double, Nodes>, Points> value{};
  std::array<double, Points> weight{};

  constexpr void set(int q, double w, const mesh::ShapesAt<Nodes, 3>& shapes) {
    weight[q] = w;
    value[q] = shapes.value;
    gradient[q] = shapes.gradient;
  }
};

/// Trilinear hexahedron, nodes in VTK's order, with 2 x 2 x 2 Gauss points.
struct Hex8 {
  static constexpr int nodes = 8;
  static constexpr int points = 8;

  static constexpr auto shapes(const std::array<double, 3>& xi) {
    return mesh::hexahedron_shapes(xi);
  }

  static constexpr Quadrature<8, 8> full_quadrature() {
    constexpr auto line = mesh::gauss<2>();
    Quadrature<8, 8> rule;
    for (int q = 0; q < 8; ++q) {
      const std::array at{line[mesh::corner_place(q, 0)], line[mesh::corner_place(q, 1)],
                          line[mesh::corner_place(q, 2)]};
      rule.set(q, at[0].weight * at[1].weight * at[2].weight, shapes({at[0].x, at[1].x, at[2].x}));
    }
    return rule;
  }
};

/// Linear tetrahedron.
struct Tet4 {
  static constexpr int nodes = 4;
  static constexpr int points = 1;

  static constexpr auto shapes(const std::array<double, 3>& xi) {
    return mesh::simplex_shapes<1, 3>(xi);
  }

  static constexpr Quadrature<1, 4> full_quadrature() {
    Quadrature<1, 4> rule;
    rule.set(0, 1.0 / 6.0, shapes({0.25, 0.25, 0.25}));
    return rule;
  }
};

}  // namespace lv::solid
