#include "lv/mesh/spread_points.hpp"

#include "lv/mesh/cell.hpp"

#include <Eigen/LU>

namespace lv::mesh {
namespace {

constexpr int per_direction = 4;  // points along each direction

/// Of the unit cube, in VTK's order.
std::array<double, 8> trilinear(const Vec3& xi) {
  const Vec3 eta = Vec3::Ones() - xi;
  return {eta.x() * eta.y() * eta.z(), xi.x() * eta.y() * eta.z(), xi.x() * xi.y() * eta.z(),
          eta.x() * xi.y() * eta.z(),  eta.x() * eta.y() * xi.z(), xi.x() * eta.y() * xi.z(),
          xi.x() * xi.y() * xi.z(),    eta.x() * xi.y() * xi.z()};
}

/// X at a point of the unit cube.
Vec3 place(const Mesh& mesh, int cell, const Vec3& xi) {
  const auto nodes = mesh.cell(cell);
  const auto shape = trilinear(xi);
  Vec3 X = Vec3::Zero();
  for (std::size_t a = 0; a < shape.size(); ++a)
    X += shape[a] * mesh.nodes[nodes[a]];
  return X;
}

/// det dX/dxi: X is linear in each coordinate.
double jacobian(const Mesh& mesh, int cell, const Vec3& xi) {
  Mat3 gradient;
  for (int d = 0; d < 3; ++d) {
    Vec3 from = xi;
    Vec3 to = xi;
    from[d] = 0.0;
    to[d] = 1.0;
    gradient.col(d) = place(mesh, cell, to) - place(mesh, cell, from);
  }
  return gradient.determinant();
}

std::vector<CellPoint> over_hexahedron(const Mesh& mesh, int cell) {
  std::vector<CellPoint> points;
  for (int k = 0; k < per_direction; ++k)
    for (int j = 0; j < per_direction; ++j)
      for (int i = 0; i < per_direction; ++i) {
        const Vec3 xi = (Vec3(i, j, k) + Vec3::Constant(0.5)) / per_direction;
        points.push_back({trilinear(xi), jacobian(mesh, cell, xi) /
                                             (per_direction * per_direction * per_direction)});
      }
  return points;
}

/// The middles of the upright ones of the small tetrahedra that it is cut into.
std::vector<CellPoint> over_tetrahedron(const Mesh& mesh, int cell) {
  std::vector<CellPoint> points;
  for (int k = 0; k < per_direction; ++k)
    for (int j = 0; j + k < per_direction; ++j)
      for (int i = 0; i + j + k < per_direction; ++i) {
        const Vec3 xi = (Vec3(i, j, k) + Vec3::Constant(0.25)) / per_direction;
        points.push_back({{1.0 - xi.sum(), xi.x(), xi.y(), xi.z()}, 0.0});
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
