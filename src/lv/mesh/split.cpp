#include "lv/mesh/split.hpp"

#include "lv/base/check.hpp"
#include "lv/mesh/cell.hpp"

#include <algorithm>

namespace lv::mesh {
namespace {

using Corners = std::array<int, 3>;

std::array<Corners, 2> split_face(const std::array<int, 4>& face) {
  const auto first = std::min_element(face.begin(), face.end()) - face.begin();
  const auto at = [&](int i) { return face[(first + i) % 4]; };
  return {{{at(0), at(1), at(2)}, {at(0), at(2), at(3)}}};
}

Surface split_faces(const Surface& surface) {
  Surface triangles;
  triangles.nodes_per_face = 3;
  for (int f = 0; f < surface.size(); ++f) {
    const auto face = surface.face(f);
    for (const Corners& t : split_face({face[0], face[1], face[2], face[3]}))
      triangles.nodes.insert(triangles.nodes.end(), t.begin(), t.end());
  }
  return triangles;
}

/// The tetrahedra between the cell's node of smallest number, from which the diagonals of its own
/// three faces start, and the triangles of the three faces opposite.
void split_cell(std::span<const int> cell, std::vector<int>& tetrahedra) {
  const int apex = *std::min_element(cell.begin(), cell.end());
  for (const LocalFace& local : cell_faces(CellKind::hexahedron)) {
    const std::array<int, 4> face{cell[local[0]], cell[local[1]], cell[local[2]], cell[local[3]]};
    if (std::find(face.begin(), face.end(), apex) != face.end())
      continue;
    for (const Corners& t : split_face(face))
      tetrahedra.insert(tetrahedra.end(), {apex, t[0], t[1], t[2]});
  }
}

}  // namespace

Mesh split_into_tetrahedra(const Mesh& hexahedra) {
  LV_CHECK(hexahedra.kind == CellKind::hexahedron);
  Mesh mesh = hexahedra;
  mesh.kind = CellKind::tetrahedron;
  mesh.cells.clear();
  for (int c = 0; c < hexahedra.cell_count(); ++c)
    split_cell(hexahedra.cell(c), mesh.cells);
  mesh.endo = split_faces(hexahedra.endo);
  mesh.epi = split_faces(hexahedra.epi);
  mesh.base = split_faces(hexahedra.base);
  return mesh;
}

}  // namespace lv::mesh
