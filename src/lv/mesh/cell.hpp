#pragma once

#include "lv/mesh/mesh.hpp"

#include <array>
#include <span>

/// Shape and topology of single cells.
namespace lv::mesh {

/// A face of a cell as local node numbers, in an order whose normal points out of the cell. The
/// fourth number of a triangle is -1.
using LocalFace = std::array<int, 4>;
[[nodiscard]] std::span<const LocalFace> cell_faces(CellKind kind);

/// The edges of a cell as pairs of local node numbers; a hexahedron's first four along the first
/// direction of the reference cube, the next along the second.
[[nodiscard]] std::span<const std::array<int, 2>> cell_edges(CellKind kind);

/// Mean of the cell's nodes [mm].
[[nodiscard]] Vec3 cell_centre(const Mesh& mesh, int cell);

/// int dX over the cell with its straight edges [mm^3]; cell_volumes (quadratic.hpp) has those of
/// curved parts. Exact: det dX/dxi of a trilinear hexahedron is of degree two in
/// each coordinate, which the 2 x 2 x 2 Gauss rule integrates.
[[nodiscard]] double cell_volume(const Mesh& mesh, int cell);

/// Mean gradient over the cell of a field with the value `field[a]` at node a, int grad f dX / V.
[[nodiscard]] Vec3 mean_gradient(const Mesh& mesh, int cell, std::span<const double> field);

/// The smallest det dX/dxi over the corners and Gauss points of the cell, with the reference cell's
/// volume scaled to one (so it is the volume of a cell that is a parallelepiped or a tetrahedron)
/// [mm^3].
[[nodiscard]] double smallest_jacobian(const Mesh& mesh, int cell);

/// Throws the InputError of a cell whose det dX/dxi [mm^3] is not positive at X [mm].
[[noreturn]] void fail_inverted(int cell, double jacobian, const Vec3& X);

/// Shape of the cell, 1 for a cube or a regular tetrahedron, 0 for a flat cell, below 0 for an
/// inverted one (P.M. Knupp, Int. J. Numer. Meth. Engng 48:1165, 2000; as in the Verdict library).
///
///   hexahedron:  min over corners of  det[e1 e2 e3] / (|e1| |e2| |e3|),  e_i the corner's edges
///   tetrahedron: sqrt(2) det[e1 e2 e3] / max over corners of (|e1| |e2| |e3|)
[[nodiscard]] double scaled_jacobian(const Mesh& mesh, int cell);

/// Slenderness of the cell, 1 for a cube or a regular tetrahedron.
///
///   hexahedron:  longest edge / shortest edge
///   tetrahedron: longest edge / (2 sqrt(6) r),  r the radius of the inscribed sphere
[[nodiscard]] double aspect_ratio(const Mesh& mesh, int cell);

}  // namespace lv::mesh
