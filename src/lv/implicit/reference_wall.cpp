#include "lv/implicit/reference_wall.hpp"

#include "lv/base/check.hpp"
#include "lv/base/parallel.hpp"
#include "lv/implicit/partition.hpp"

#include <algorithm>
#include <map>

namespace lv::implicit {
namespace {

using mesh::CellKind;

/// Pressure unknowns: each hexahedron's own; of tetrahedra, one per corner.
mesh::ElementNodes number_pressures(const mesh::Mesh& mesh, const mesh::ElementNodes& elements,
                                    int per_element) {
  mesh::ElementNodes pressures{per_element, {}};
  std::map<int, int> of_corner;
  for (int e = 0; e < elements.size(); ++e) {
    for (int m = 0; m < per_element; ++m) {
      if (mesh.kind == CellKind::hexahedron) {
        pressures.nodes.push_back(e * per_element + m);
        continue;
      }
      const int next = static_cast<int>(of_corner.size());
      pressures.nodes.push_back(of_corner.emplace(elements.element(e)[m], next).first->second);
    }
  }
  return pressures;
}

}  // namespace

ReferenceWall reference_wall(const mesh::Mesh& mesh) {
  if (mesh.kind == CellKind::tetrahedron && mesh.order == 1)
    throw InputError("anatomy.mesh.refinements",
                     "is 0, but linear tetrahedra lock in the quasi-static engine",
                     "Set it to 1: the parts of a refined tetrahedron make a quadratic one");
  ReferenceWall wall;
  wall.elements = mesh::elements(mesh);
  wall.pressure_shapes = solid::pressure_shapes(mesh.kind, mesh.order);
  wall.pressures = number_pressures(mesh, wall.elements, wall.pressure_shapes.nodes());
  wall.pressure_count =
      *std::max_element(wall.pressures.nodes.begin(), wall.pressures.nodes.end()) + 1;
  wall.owners = partition(wall.elements, parallel::size());
  const int parts = mesh::cells_per_element(mesh.order);
  const PointMaker maker(mesh);
  const solid::ShapeTable shapes = solid::element_shapes(mesh.kind, mesh.order);
  for (int e = 0; e < wall.elements.size(); ++e) {
    if (wall.owners[e] != parallel::rank())
      continue;
    wall.own.push_back(e);
    wall.points.push_back(maker.points(shapes, parts * e, wall.elements.element(e)));
  }
  return wall;
}

bool is_sound(const mesh::Mesh& mesh) {
  const mesh::ElementNodes elements = mesh::elements(mesh);
  const solid::ShapeTable shapes = solid::element_shapes(mesh.kind, mesh.order);
  Eigen::Matrix3Xd X(3, elements.nodes_per_element);
  for (int e = 0; e < elements.size(); ++e) {
    for (int a = 0; a < elements.nodes_per_element; ++a)
      X.col(a) = mesh.nodes[elements.element(e)[a]];
    for (const Eigen::MatrixXd& gradient : shapes.gradient)
      if (!(determinant(Mat3(X * gradient.transpose())) > 0.0))
        return false;
  }
  return true;
}

}  // namespace lv::implicit
