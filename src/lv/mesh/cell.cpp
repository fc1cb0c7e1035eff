#include "lv/mesh/cell.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/gauss.hpp"
#include "lv/mesh/shapes.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lv::mesh {
namespace {

constexpr std::array<LocalFace, 6> hexahedron_faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
constexpr std::array<LocalFace, 4> tetrahedron_faces{
    {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}}};

constexpr std::array<std::array<int, 2>, 12> hexahedron_edges{{{0, 1},
                                                               {3, 2},
                                                               {4, 5},
                                                               {7, 6},
                                                               {0, 3},
                                                               {1, 2},
                                                               {4, 7},
                                                               {5, 6},
                                                               {0, 4},
                                                               {1, 5},
                                                               {3, 7},
                                                               {2, 6}}};
constexpr std::array<std::array<int, 2>, 6> tetrahedron_edges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

Vec3 edge_vector(const Mesh& mesh, int cell, const std::array<int, 2>& edge) {
  const auto nodes = mesh.cell(cell);
  return mesh.nodes[nodes[edge[1]]] - mesh.nodes[nodes[edge[0]]];
}

/// dX/dxi
Mat3 hexahedron_gradient(const Mesh& mesh, int cell, const Vec3& xi) {
  const auto shapes = hexahedron_shapes({xi.x(), xi.y(), xi.z()});
  return jacobian(mesh, point_of(mesh, cell, shapes));
}

/// df/dxi
Vec3 hexahedron_derivative(const Mesh& mesh, int cell, std::span<const double> field,
                           const Vec3& xi) {
  const auto shapes = hexahedron_shapes({xi.x(), xi.y(), xi.z()});
  Vec3 derivative = Vec3::Zero();
  for (int a = 0; a < 8; ++a)
    derivative += field[mesh.cell(cell)[a]] * Vec3(shapes.gradient[a].data());
  return derivative;
}

Mat3 tetrahedron_gradient(const Mesh& mesh, int cell) {
  Mat3 gradient;
  for (int d = 0; d < 3; ++d)
    gradient.col(d) = edge_vector(mesh, cell, {0, d + 1});
  return gradient;
}

/// Two places along each edge of the unit cube: its corners, and the points of the Gauss rule that
/// has all weights the same.
using Pair = std::array<double, 2>;
constexpr Pair ends{0.0, 1.0};
constexpr Pair gauss_places{gauss<2>()[0].x, gauss<2>()[1].x};

Vec3 cube_point(int number, const Pair& places) {
  return {places[number & 1], places[(number >> 1) & 1], places[(number >> 2) & 1]};
}

double product_of_lengths(const Mat3& edges) {
  return edges.col(0).norm() * edges.col(1).norm() * edges.col(2).norm();
}

double ratio(double numerator, double denominator) {
  return denominator > 0.0 ? numerator / denominator : 0.0;
}

double tetrahedron_scaled_jacobian(const Mesh& mesh, int cell) {
  const auto nodes = mesh.cell(cell);
  double largest = 0.0;
  for (int a = 0; a < 4; ++a) {
    double product = 1.0;
    for (int b = 1; b < 4; ++b)
      product *= (mesh.nodes[nodes[(a + b) % 4]] - mesh.nodes[nodes[a]]).norm();
    largest = std::max(largest, product);
  }
  return ratio(std::sqrt(2.0) * tetrahedron_gradient(mesh, cell).determinant(), largest);
}

double inscribed_radius(const Mesh& mesh, int cell) {
  const auto nodes = mesh.cell(cell);
  double area = 0.0;
  for (const LocalFace& face : tetrahedron_faces) {
    const Vec3& x = mesh.nodes[nodes[face[0]]];
    area += 0.5 * (mesh.nodes[nodes[face[1]]] - x).cross(mesh.nodes[nodes[face[2]]] - x).norm();
  }
  return ratio(3.0 * cell_volume(mesh, cell), area);
}

}  // namespace

std::span<const LocalFace> cell_faces(CellKind kind) {
  if (kind == CellKind::hexahedron)
    return hexahedron_faces;
  return tetrahedron_faces;
}

std::span<const std::array<int, 2>> cell_edges(CellKind kind) {
  if (kind == CellKind::hexahedron)
    return hexahedron_edges;
  return tetrahedron_edges;
}

Vec3 cell_centre(const Mesh& mesh, int cell) {
  Vec3 sum = Vec3::Zero();
  for (const int node : mesh.cell(cell))
    sum += mesh.nodes[node];
  return sum / nodes_per_cell(mesh.kind);
}

double cell_volume(const Mesh& mesh, int cell) {
  if (mesh.kind == CellKind::tetrahedron)
    return tetrahedron_gradient(mesh, cell).determinant() / 6.0;
  double volume = 0.0;
  for (int q = 0; q < 8; ++q)
    volume += hexahedron_gradient(mesh, cell, cube_point(q, gauss_places)).determinant() / 8.0;
  return volume;
}

Vec3 mean_gradient(const Mesh& mesh, int cell, std::span<const double> field) {
  if (mesh.kind == CellKind::tetrahedron) {
    const auto nodes = mesh.cell(cell);
    const double f = field[nodes[0]];
    const Vec3 differences(field[nodes[1]] - f, field[nodes[2]] - f, field[nodes[3]] - f);
    return tetrahedron_gradient(mesh, cell).inverse().transpose() * differences;
  }
  Vec3 integral = Vec3::Zero();
  for (int q = 0; q < 8; ++q) {
    const Vec3 xi = cube_point(q, gauss_places);
    const Mat3 dX_dxi = hexahedron_gradient(mesh, cell, xi);
    integral += dX_dxi.determinant() / 8.0 * dX_dxi.inverse().transpose() *
                hexahedron_derivative(mesh, cell, field, xi);
  }
  return integral / cell_volume(mesh, cell);
}

double smallest_jacobian(const Mesh& mesh, int cell) {
  if (mesh.kind == CellKind::tetrahedron)
    return cell_volume(mesh, cell);
  double smallest = std::numeric_limits<double>::max();
  for (int q = 0; q < 8; ++q)
    for (const Pair& places : {ends, gauss_places})
      smallest =
          std::min(smallest, hexahedron_gradient(mesh, cell, cube_point(q, places)).determinant());
  return smallest;
}

void fail_inverted(int cell, double jacobian, const Vec3& X) {
  throw InputError(
      fmt::format("element {} of the wall mesh", cell),
      fmt::format("is inverted or collapsed (Jacobian {:.3g} mm^3 at ({:.1f}, {:.1f}, {:.1f}) mm)",
                  jacobian, X.x(), X.y(), X.z()),
      "Repair the mesh, or change the edge length");
}

double scaled_jacobian(const Mesh& mesh, int cell) {
  if (mesh.kind == CellKind::tetrahedron)
    return tetrahedron_scaled_jacobian(mesh, cell);
  double smallest = 1.0;
  for (int q = 0; q < 8; ++q) {
    const Mat3 edges = hexahedron_gradient(mesh, cell, cube_point(q, ends));
    smallest = std::min(smallest, ratio(edges.determinant(), product_of_lengths(edges)));
  }
  return smallest;
}

double aspect_ratio(const Mesh& mesh, int cell) {
  double shortest = std::numeric_limits<double>::max();
  double longest = 0.0;
  for (const auto& edge : cell_edges(mesh.kind)) {
    const double length = edge_vector(mesh, cell, edge).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  if (mesh.kind == CellKind::hexahedron)
    return longest / shortest;
  return longest / (2.0 * std::sqrt(6.0) * inscribed_radius(mesh, cell));
}

}  // namespace lv::mesh
