#pragma once

#include "lv/base/tensor.hpp"

#include <array>

namespace lv::solid {

/// Gradients of an element's shape functions at its quadrature points, in the reference element:
/// `gradient[q][a]` for point q and node a; `weight[q]` of point q.
template <int Points, int Nodes>
struct Quadrature {
  std::array<std::array<std::array<double, 3>, Nodes>, Points> gradient{};
  std::array<std::array<double, Nodes>, Points> value{};
  std::array<double, Points> weight{};
};

/// Trilinear hexahedron on [-1,1]^3, nodes in VTK's order.
struct Hex8 {
  static constexpr int nodes = 8;
  static constexpr int points = 8;  ///< 2 x 2 x 2 Gauss points
  static constexpr int nodes_per_face = 4;
  static constexpr std::array<std::array<double, 3>, 8> corner{{{-1, -1, -1},
                                                                {1, -1, -1},
                                                                {1, 1, -1},
                                                                {-1, 1, -1},
                                                                {-1, -1, 1},
                                                                {1, -1, 1},
                                                                {1, 1, 1},
                                                                {-1, 1, 1}}};

  static constexpr double value(int a, const std::array<double, 3>& xi) {
    return 0.125 * (1 + corner[a][0] * xi[0]) * (1 + corner[a][1] * xi[1]) *
           (1 + corner[a][2] * xi[2]);
  }
  static constexpr std::array<double, 3> gradient(int a, const std::array<double, 3>& xi) {
    const double x = 1 + corner[a][0] * xi[0];
    const double y = 1 + corner[a][1] * xi[1];
    const double z = 1 + corner[a][2] * xi[2];
    return {0.125 * corner[a][0] * y * z, 0.125 * corner[a][1] * x * z,
            0.125 * corner[a][2] * x * y};
  }

  static constexpr Quadrature<8, 8> full_quadrature() {
    constexpr double g = 0.57735026918962576;  // 1/sqrt(3)
    Quadrature<8, 8> rule;
    for (int q = 0; q < 8; ++q) {
      const std::array<double, 3> xi{g * corner[q][0], g * corner[q][1], g * corner[q][2]};
      rule.weight[q] = 1.0;
      for (int a = 0; a < 8; ++a) {
        rule.gradient[q][a] = gradient(a, xi);
        rule.value[q][a] = value(a, xi);
      }
    }
    return rule;
  }
};

/// Linear tetrahedron on the unit simplex.
struct Tet4 {
  static constexpr int nodes = 4;
  static constexpr int points = 1;
  static constexpr int nodes_per_face = 3;

  static constexpr double value(int a, const std::array<double, 3>& xi) {
    return a == 0 ? 1 - xi[0] - xi[1] - xi[2] : xi[a - 1];
  }
  static constexpr std::array<double, 3> gradient(int a, const std::array<double, 3>& /*xi*/) {
    if (a == 0)
      return {-1, -1, -1};
    std::array<double, 3> e{0, 0, 0};
    e[a - 1] = 1;
    return e;
  }

  static constexpr Quadrature<1, 4> full_quadrature() {
    Quadrature<1, 4> rule;
    rule.weight[0] = 1.0 / 6.0;
    for (int a = 0; a < 4; ++a) {
      rule.gradient[0][a] = gradient(a, {0.25, 0.25, 0.25});
      rule.value[0][a] = 0.25;
    }
    return rule;
  }
};

}  // namespace lv::solid
