#pragma once

#include "lv/mesh/mesh.hpp"

namespace lv::mesh {

/// Every cell cut into eight by the middles of its edges, faces and (hexahedra) itself. The wall
/// keeps its shape: old nodes keep their numbers and places, new ones lie on the old faces, and t
/// and M(X) are interpolated, as directions of fibres are that stand at nodes. The octahedron left
/// in the middle of a tetrahedron is cut along its shortest diagonal. The result is of order 2: its
/// cells hang together as quadratic elements.
[[nodiscard]] Mesh refine(const Mesh& mesh);

/// A refined mesh, and the old nodes in whose middle each of its nodes lies (one for an old node).
struct Refinement {
  Mesh mesh;
  std::vector<std::vector<int>> middle_of;
};
[[nodiscard]] Refinement refinement(const Mesh& mesh);

/// A flag per cell, handed on to the eight cells that refine() makes of it.
[[nodiscard]] std::vector<bool> refine_flags(const std::vector<bool>& cells);

/// The same of a number per cell.
[[nodiscard]] std::vector<double> refine_numbers(const std::vector<double>& cells);

}  // namespace lv::mesh
