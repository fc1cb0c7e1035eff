#include "support/block_mesh.hpp"

#include "lv/mesh/cell.hpp"
#include "lv/mesh/split.hpp"
#include "lv/mesh/surface.hpp"

#include "support/random_values.hpp"

#include <algorithm>

namespace lv::test {
namespace {

constexpr double width = 2.0;  // of a cell [mm]

using mesh::Mesh;

/// Boundary faces whose nodes all satisfy `on_side`.
template <class OnSide>
mesh::Surface side(const Mesh& block, const OnSide& on_side) {
  const mesh::Surface all = mesh::boundary(block);
  mesh::Surface chosen{all.nodes_per_face, {}};
  for (int f = 0; f < all.size(); ++f) {
    const auto face = all.face(f);
    if (std::all_of(face.begin(), face.end(), on_side))
      chosen.nodes.insert(chosen.nodes.end(), face.begin(), face.end());
  }
  return chosen;
}

Mesh lattice(int n) {
  Mesh mesh;
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.nodes.emplace_back(width * Vec3(i, j, k));
  const auto node = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const int up : {0, 1})
          for (const auto& [right, back] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
            mesh.cells.push_back(node(i + right, j + back, k + up));
  mesh.infarct.assign(mesh.nodes.size(), 0.0);
  mesh.transmural.assign(mesh.nodes.size(), 0.0);
  return mesh;
}

Mesh hexahedra(int n) {
  constexpr double distortion = 0.3;
  RandomValues random(11);
  Mesh block = lattice(n);
  for (Vec3& X : block.nodes)
    X = Vec3(15.0, 4.0, -6.0) + X + distortion * random.vector();
  block.endo = side(block, [&](int a) { return a % (n + 1) == 0; });
  block.epi = side(block, [&](int a) { return a % (n + 1) == n; });
  block.base = side(block, [&](int a) { return a / ((n + 1) * (n + 1)) == n; });
  for (std::size_t a = 0; a < block.nodes.size(); ++a)
    block.transmural[a] = (block.nodes[a].x() - 15.0) / (width * n);
  return block;
}

Mesh of_kind(mesh::CellKind kind, const Mesh& hexahedra) {
  return kind == mesh::CellKind::hexahedron ? hexahedra : mesh::split_into_tetrahedra(hexahedra);
}

}  // namespace

Mesh block_mesh(mesh::CellKind kind, int n) {
  return of_kind(kind, hexahedra(n));
}

Mesh cubes(mesh::CellKind kind, int n) {
  return of_kind(kind, lattice(n));
}

std::vector<Vec3> moved(std::span<const Vec3> nodes, const Mat3& F, const Vec3& c) {
  std::vector<Vec3> result;
  for (const Vec3& X : nodes)
    result.emplace_back(F * X + c);
  return result;
}

double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (int c = 0; c < mesh.cell_count(); ++c)
    sum += mesh::cell_volume(mesh, c);
  return sum;
}

Vec3 resultant(std::span<const Vec3> forces) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& F : forces)
    sum += F;
  return sum;
}

Vec3 torque(std::span<const Vec3> positions, std::span<const Vec3> forces) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t a = 0; a < forces.size(); ++a)
    sum += positions[a].cross(forces[a]);
  return sum;
}

double work(std::span<const Vec3> forces, std::span<const Vec3> displacements) {
  double sum = 0.0;
  for (std::size_t a = 0; a < forces.size(); ++a)
    sum += forces[a].dot(displacements[a]);
  return sum;
}

double magnitude(std::span<const Vec3> forces) {
  double sum = 0.0;
  for (const Vec3& F : forces)
    sum += F.norm();
  return sum;
}

std::vector<Vec3> displaced(std::span<const Vec3> positions, std::span<const Vec3> displacements,
                            double scale) {
  std::vector<Vec3> result(positions.begin(), positions.end());
  for (std::size_t a = 0; a < result.size(); ++a)
    result[a] += scale * displacements[a];
  return result;
}

}  // namespace lv::test
