#include "lv/quasi_static/reference_wall.hpp"

#include "lv/base/check.hpp"
#include "lv/base/parallel.hpp"
#include "lv/mesh/cell.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <map>

namespace lv::quasi_static {
namespace {

using mesh::CellKind;

Eigen::Matrix3Xd gather(std::span<const Vec3> values, std::span<const int> nodes) {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t a = 0; a < nodes.size(); ++a)
    result.col(static_cast<Eigen::Index>(a)) = values[nodes[a]];
  return result;
}

Eigen::VectorXd gather(std::span<const double> values, std::span<const int> nodes) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t a = 0; a < nodes.size(); ++a)
    result[static_cast<Eigen::Index>(a)] = values[nodes[a]];
  return result;
}

/// Makes the points of one element after the other.
class PointMaker {
 public:
  PointMaker(const mesh::Mesh& mesh, const mesh::FibreRule& fibres)
      : mesh_(mesh),
        fibres_(fibres),
        shapes_(solid::element_shapes(mesh.kind, mesh.order)),
        radial_(mesh.kind == CellKind::tetrahedron ? mesh::radial_directions(mesh)
                                                   : std::vector<Vec3>{}) {}

  [[nodiscard]] std::vector<Point> points(int element, std::span<const int> nodes) const {
    const Eigen::Matrix3Xd X = gather(mesh_.nodes, nodes);
    const Eigen::VectorXd t = gather(mesh_.transmural, nodes);
    const Eigen::VectorXd M = gather(mesh_.infarct, nodes);
    std::vector<Point> result;
    for (int q = 0; q < shapes_.points(); ++q) {
      const Eigen::Matrix3Xd to_xi = shapes_.gradient[q];
      const Eigen::VectorXd phi = shapes_.value.row(q);
      const Mat3 dX_dxi = X * to_xi.transpose();
      const double det = dX_dxi.determinant();
      if (!(det > 0.0))
        mesh::fail_inverted(element * (mesh_.order == 2 ? 8 : 1), det, X * phi);
      const Eigen::Matrix3Xd gradient = dX_dxi.inverse().transpose() * to_xi;
      const Vec3 radial = radial_.empty() ? Vec3(gradient * t) : Vec3(gather(radial_, nodes) * phi);
      const Mat3 frame = mesh::fibre_frame(fibres_, mesh::wall_axes(radial), phi.dot(t));
      result.push_back({frame.transpose() * gradient, det * shapes_.weight[q],
                        std::clamp(phi.dot(M), 0.0, 1.0)});
    }
    return result;
  }

 private:
  const mesh::Mesh& mesh_;
  mesh::FibreRule fibres_;
  solid::ShapeTable shapes_;
  std::vector<Vec3> radial_;  ///< per node of tetrahedra, whose own grad t may vanish
};

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

ReferenceWall reference_wall(const mesh::Mesh& mesh, const mesh::FibreRule& fibres) {
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
  const auto share = parallel::share(wall.elements.size(), parallel::rank(), parallel::size());
  wall.first_element = share.begin;
  const PointMaker maker(mesh, fibres);
  for (int e = share.begin; e < share.end; ++e)
    wall.points.push_back(maker.points(e, wall.elements.element(e)));
  return wall;
}

}  // namespace lv::quasi_static
