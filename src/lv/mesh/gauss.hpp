#pragma once

#include <array>
#include <vector>

namespace lv::mesh {

/// A point of a rule on the unit interval: int f dx = sum weight f(x).
struct LinePoint {
  double x, weight;
};

/// Gauss and Legendre's points, in ascending order: exact for polynomials of degree 2 Count - 1.
template <int Count>
requires(Count == 2 || Count == 3) constexpr std::array<LinePoint, Count> gauss() {
  if constexpr (Count == 2)
    return {{{0.21132486540518711775, 0.5}, {0.78867513459481288225, 0.5}}};
  else
    return {{{0.11270166537925831148, 5.0 / 18.0},
             {0.5, 4.0 / 9.0},
             {0.88729833462074168852, 5.0 / 18.0}}};
}

/// The same of any number.
[[nodiscard]] std::vector<LinePoint> gauss(int count);

}  // namespace lv::mesh
