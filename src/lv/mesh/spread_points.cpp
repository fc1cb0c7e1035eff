#include "lv/mesh/spread_points.hpp"

#include "lv/mesh/cell.hpp"
#include "lv/mesh/shapes.hpp"

#include <Eigen/LU>

namespace lv::mesh {
namespace {

constexpr int per_direction = 4;  // points along each direction

/// Its share of the way, from 0 to 1.
constexpr double along(double i) {
  return i / per_direction;
}

std::vector<CellPoint> over_hexahedron(const Mesh& mesh, int cell) {
  constexpr int count = per_direction * per_direction * per_direction;
  std::vector<CellPoint> points;
  for (int k = 0; k < per_direction; ++k)
    for (int j = 0; j < per_direction; ++j)
      for (int i = 0; i < per_direction; ++i) {
        const auto s = hexahedron_shapes({along(i + 0.5), along(j + 0.5), along(k + 0.5)});
        const double det = jacobian(mesh, point_of(mesh, cell, s)).determinant();
        points.push_back({s.value, det / count});
      }
  return points;
}

/// The middles of the upright ones of the small tetrahedra that it is cut into.
std::vector<CellPoint> over_tetrahedron(const Mesh& mesh, int cell) {
  std::vector<CellPoint> points;
  for (int k = 0; k < per_direction; ++k)
    for (int j = 0; j + k < per_direction; ++j)
      for (int i = 0; i + j + k < per_direction; ++i) {
        const auto phi =
            simplex_shapes<1, 3>({along(i + 0.25), along(j + 0.25), along(k + 0.25)}).value;
        points.push_back({{phi[0], phi[1], phi[2], phi[3]}, 0.0});
      }
  for (CellPoint& point : points)
    point.volume = cell_volume(mesh, cell) / static_cast<double>(points.size());
  return points;
}

}  // namespace

std::vector<CellPoint> spread_points(const Mesh& mesh, int cell) {
  return mesh.kind == CellKind::hexahedron ? over_hexahedron(mesh, cell)
                                           : over_tetrahedron(mesh, cell);
}

}  // namespace lv::mesh
