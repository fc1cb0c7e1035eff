#include "lv/mesh/shapes.hpp"

#include "lv/base/check.hpp"

namespace lv::mesh {
namespace {

template <int N, int Dim>
Shapes as_matrices(const ShapesAt<N, Dim>& at) {
  return {Eigen::Map<const Eigen::VectorXd>(at.value.data(), N),
          Eigen::Map<const Eigen::MatrixXd>(at.gradient.front().data(), Dim, N)};
}

}  // namespace

template <int Dim>
Shapes shapes(CellKind kind, int order, const std::array<double, Dim>& xi) {
  LV_CHECK(order == 1 || order == 2);
  if (kind == CellKind::hexahedron)
    return order == 1 ? as_matrices(lattice_shapes<1, Dim>(xi))
                      : as_matrices(lattice_shapes<2, Dim>(xi));
  return order == 1 ? as_matrices(simplex_shapes<1, Dim>(xi))
                    : as_matrices(simplex_shapes<2, Dim>(xi));
}

template Shapes shapes<2>(CellKind, int, const std::array<double, 2>&);
template Shapes shapes<3>(CellKind, int, const std::array<double, 3>&);

Mat3 jacobian(const Mesh& mesh, const ElementPoint& point) {
  Mat3 dX_dxi = Mat3::Zero();
  for (std::size_t a = 0; a < point.nodes.size(); ++a)
    dX_dxi += mesh.nodes[point.nodes[a]] * Vec3(point.gradient.data() + 3 * a).transpose();
  return dX_dxi;
}

std::vector<Vec3> node_places(CellKind kind, int order) {
  std::vector<Vec3> places;
  if (kind == CellKind::hexahedron) {
    for (int k = 0; k <= order; ++k)
      for (int j = 0; j <= order; ++j)
        for (int i = 0; i <= order; ++i)
          places.emplace_back(Vec3(i, j, k) / order);
    return places;
  }
  places = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  if (order == 2)
    for (const auto& [a, b] : simplex_edges)
      places.emplace_back(0.5 * (places[a] + places[b]));
  return places;
}

}  // namespace lv::mesh
