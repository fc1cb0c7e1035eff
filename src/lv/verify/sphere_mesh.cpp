#include "lv/verify/sphere_mesh.hpp"

#include <cmath>
#include <map>
#include <numbers>

namespace lv::verify {
namespace {

using Lattice = std::array<int, 3>;  ///< a point of the cube's surface, each from 0 to n

/// The points and squares of a cube's surface.
struct CubeSurface {
  explicit CubeSurface(int squares_along) : n(squares_along) {
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, n})
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            add_square(axis, side, i, j);
  }

  void add_square(int axis, int side, int i, int j) {
    const auto corner = [&](int di, int dj) {
      Lattice at{};
      at[axis] = side;
      at[(axis + 1) % 3] = i + di;
      at[(axis + 2) % 3] = j + dj;
      return index(at);
    };
    const std::array<int, 4> square{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    if (side > 0)
      squares.push_back(square);
    else
      squares.push_back({square[0], square[3], square[2], square[1]});
  }

  int index(const Lattice& at) {
    const auto [place, is_new] = indices.try_emplace(at, static_cast<int>(directions.size()));
    if (is_new) {
      Vec3 direction;
      for (int d = 0; d < 3; ++d)
        direction[d] = std::tan(std::numbers::pi / 4 * (2.0 * at[d] / n - 1.0));
      directions.push_back(direction.normalized());
    }
    return place->second;
  }

  int n;
  std::map<Lattice, int> indices;
  std::vector<Vec3> directions;
  std::vector<std::array<int, 4>> squares;  ///< anticlockwise seen from outside
};

}  // namespace

mesh::Mesh spherical_shell(double inner_radius, double outer_radius, int around, int layers) {
  const CubeSurface cube(around);
  const int per_layer = static_cast<int>(cube.directions.size());
  mesh::Mesh m;
  for (int l = 0; l <= layers; ++l) {
    const double t = static_cast<double>(l) / layers;
    for (const Vec3& direction : cube.directions) {
      m.nodes.emplace_back(((1.0 - t) * inner_radius + t * outer_radius) * direction);
      m.transmural.push_back(t);
    }
  }
  m.infarct.assign(m.nodes.size(), 0.0);
  for (int l = 0; l < layers; ++l)
    for (const auto& square : cube.squares)
      for (const int layer : {l, l + 1})
        for (const int corner : square)
          m.cells.push_back(layer * per_layer + corner);
  for (const auto& [a, b, c, d] : cube.squares) {
    const int top = layers * per_layer;
    m.endo.nodes.insert(m.endo.nodes.end(), {a, d, c, b});
    m.epi.nodes.insert(m.epi.nodes.end(), {top + a, top + b, top + c, top + d});
  }
  return m;
}

}  // namespace lv::verify
