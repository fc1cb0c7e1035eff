#pragma once

#include "lv/base/tensor.hpp"
#include "lv/mesh/fibre_rule.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace lv::mesh {

/// Eight-node hexahedra or four-node tetrahedra, nodes in VTK's order (a hexahedron's first four
/// nodes see the last four on their left-hand side going round; both have positive volume).
enum class CellKind { hexahedron, tetrahedron };

[[nodiscard]] constexpr int nodes_per_cell(CellKind kind) {
  return kind == CellKind::hexahedron ? 8 : 4;
}

/// Faces of cells on one side of the wall, with normals that point out of the wall: four nodes each
/// on hexahedra, three on tetrahedra.
struct Surface {
  int nodes_per_face = 4;
  std::vector<int> nodes;  ///< face after face

  [[nodiscard]] int size() const { return static_cast<int>(nodes.size()) / nodes_per_face; }
  [[nodiscard]] std::span<const int> face(int f) const {
    return {nodes.data() + static_cast<std::ptrdiff_t>(f) * nodes_per_face,
            static_cast<std::size_t>(nodes_per_face)};
  }
};

/// Directions of the muscle that a file brings: unit vectors, whose signs mean nothing.
struct GivenFibres {
  /// Where they stand: one for each cell, or one for each node, between which they turn evenly.
  enum class At { cells, nodes } at = At::cells;
  std::vector<Vec3> f0;  ///< along the fibres; empty: fibres and sheets follow a rule
  std::vector<Vec3> s0;  ///< across the fibres in the sheets; empty: sheets follow a rule
};

/// Where the fibres of a wall run and its sheets lie: as a rule says, but for what is given.
struct Fibres {
  FibreRule rule;
  GivenFibres given;
};

/// The wall of the left ventricle at early diastole in the model frame: z along the long axis, the
/// base in the plane z = 0, the apex at negative z [mm].
struct Mesh {
  CellKind kind = CellKind::hexahedron;
  std::vector<Vec3> nodes;
  std::vector<int> cells;  ///< nodes of cell after cell
  Surface endo, epi, base;
  /// 1: nothing more than the cells. 2: eight consecutive cells are the parts of one quadratic
  /// element, and four consecutive faces those of its side, in the order of refine()
  /// (quadratic.hpp).
  int order = 1;
  std::vector<double> transmural;  ///< per node: 0 on the endocardium, 1 on the epicardium
  std::vector<double> infarct;     ///< per node: M(X) of (2.11), 0 in healthy muscle
  Fibres fibres;
  /// Per cell: the segment of the American Heart Association whose muscle it is, 1 to 17; empty:
  /// the muscle is the same everywhere.
  std::vector<int> segment;

  [[nodiscard]] int cell_count() const {
    return static_cast<int>(cells.size()) / nodes_per_cell(kind);
  }
  [[nodiscard]] std::span<const int> cell(int c) const {
    const int n = nodes_per_cell(kind);
    return {cells.data() + static_cast<std::ptrdiff_t>(c) * n, static_cast<std::size_t>(n)};
  }
};

/// The nodes of a surface, each once, in ascending order.
[[nodiscard]] std::vector<int> surface_nodes(const Surface& surface);

/// The edge of `surface` as directed pairs of nodes: sides that belong to one face only.
[[nodiscard]] std::vector<std::array<int, 2>> boundary_edges(const Surface& surface);

}  // namespace lv::mesh
