#include "lv/mesh/quadratic.hpp"

#include "lv/mesh/cell.hpp"
#include "lv/mesh/gauss.hpp"
#include "lv/mesh/shapes.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <map>

namespace lv::mesh {
namespace {

/// Where a node of an element is found: in a part of it, at a place of that part.
struct Place {
  int part, node;
};

std::vector<Place> hexahedron_places(int order) {
  // the part whose near corner (or, at the far end, far corner) lies at (i, j, k)
  const auto part = [&](int at) { return order == 1 ? 0 : std::min(at, 1); };
  const auto corner = [&](int at) { return at == order ? 1 : 0; };
  std::vector<Place> places;
  for (int k = 0; k <= order; ++k)
    for (int j = 0; j <= order; ++j)
      for (int i = 0; i <= order; ++i)
        places.push_back({part(k) * 4 + part(j) * 2 + part(i),
                          hexahedron_corner[corner(k) * 4 + corner(j) * 2 + corner(i)]});
  return places;
}

/// As refine() cuts them.
std::vector<Place> places(CellKind kind, int order) {
  if (kind == CellKind::hexahedron)
    return hexahedron_places(order);
  if (order == 1)
    return {{0, 0}, {0, 1}, {0, 2}, {0, 3}};
  return {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
}

std::vector<Place> side_places(CellKind kind, int order) {
  if (kind == CellKind::hexahedron && order == 1)
    return {{0, 0}, {0, 1}, {0, 3}, {0, 2}};
  if (kind == CellKind::hexahedron)
    return {{0, 0}, {0, 1}, {1, 0}, {0, 3}, {0, 2}, {1, 1}, {3, 0}, {2, 1}, {2, 0}};
  if (order == 1)
    return {{0, 0}, {0, 1}, {0, 2}};
  return {{1, 0}, {2, 0}, {3, 0}, {0, 0}, {0, 1}, {0, 2}};
}

ElementNodes gather(std::span<const int> nodes, int nodes_per_part, int parts,
                    const std::vector<Place>& at) {
  ElementNodes result;
  result.nodes_per_element = static_cast<int>(at.size());
  const std::size_t stride = static_cast<std::size_t>(nodes_per_part) * parts;
  for (std::size_t first = 0; first < nodes.size(); first += stride)
    for (const Place& p : at)
      result.nodes.push_back(
          nodes[first + static_cast<std::size_t>(p.part) * nodes_per_part + p.node]);
  return result;
}

/// A cell's corners as those of a hexahedron: a tetrahedron is one with an edge of its bottom and
/// its whole top drawn together.
std::array<int, 8> as_hexahedron(CellKind kind) {
  return kind == CellKind::hexahedron ? std::array{0, 1, 2, 3, 4, 5, 6, 7}
                                      : std::array{0, 1, 2, 2, 3, 3, 3, 3};
}

/// Weights and d phi_a/d xi_d at points of a quadratic element.
using Rule = std::vector<std::pair<double, Eigen::MatrixXd>>;

/// Over the part with these corners. Three points each way are exact: det(dX/dxi) is of degree 5 in
/// each coordinate of a hexahedron; in a tetrahedron it is of degree 3, and drawing the hexahedron
/// together adds 2.
Rule rule_of_part(CellKind kind, const std::array<Vec3, 8>& corners) {
  Rule rule;
  for (const LinePoint& x : gauss<3>())
    for (const LinePoint& y : gauss<3>())
      for (const LinePoint& z : gauss<3>()) {
        const auto shape = hexahedron_shapes({x.x, y.x, z.x});
        Vec3 xi = Vec3::Zero();
        Mat3 jacobian = Mat3::Zero();
        for (int a = 0; a < 8; ++a) {
          xi += shape.value[a] * corners[a];
          jacobian += corners[a] * Vec3(shape.gradient[a].data()).transpose();
        }
        rule.emplace_back(x.weight * y.weight * z.weight * jacobian.determinant(),
                          shapes<3>(kind, 2, {xi.x(), xi.y(), xi.z()}).gradient);
      }
  return rule;
}

double integral(const Rule& rule, const Eigen::Matrix3Xd& X) {
  double volume = 0.0;
  for (const auto& [weight, gradient] : rule)
    volume += weight * Mat3(X * gradient.transpose()).determinant();
  return volume;
}

/// The volumes of the parts of quadratic elements.
std::vector<double> part_volumes(const Mesh& mesh) {
  const ElementNodes all = elements(mesh);
  const std::vector<Vec3> places = node_places(mesh.kind, 2);
  std::map<std::array<int, 8>, Rule> rules;  // by the places of a part's corners
  std::vector<double> volumes;
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const auto element = all.element(c / cells_per_element(2));
    Eigen::Matrix3Xd X(3, all.nodes_per_element);
    for (std::size_t a = 0; a < element.size(); ++a)
      X.col(static_cast<Eigen::Index>(a)) = mesh.nodes[element[a]];
    std::array<int, 8> at = as_hexahedron(mesh.kind);
    std::array<Vec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
      const auto node = std::find(element.begin(), element.end(), mesh.cell(c)[at[i]]);
      at[i] = static_cast<int>(node - element.begin());
      corners[i] = places.at(at[i]);
    }
    const auto [entry, added] = rules.try_emplace(at);
    if (added)
      entry->second = rule_of_part(mesh.kind, corners);
    volumes.push_back(integral(entry->second, X));
  }
  return volumes;
}

}  // namespace

ElementNodes elements(const Mesh& mesh) {
  return gather(mesh.cells, nodes_per_cell(mesh.kind), cells_per_element(mesh.order),
                places(mesh.kind, mesh.order));
}

ElementNodes sides(CellKind kind, int order, const Surface& surface) {
  return gather(surface.nodes, surface.nodes_per_face, order == 2 ? 4 : 1,
                side_places(kind, order));
}

std::vector<double> cell_volumes(const Mesh& mesh) {
  if (mesh.order == 2)
    return part_volumes(mesh);
  std::vector<double> volumes;
  for (int c = 0; c < mesh.cell_count(); ++c)
    volumes.push_back(cell_volume(mesh, c));
  return volumes;
}

}  // namespace lv::mesh
