#pragma once

#include "lv/mesh/mesh.hpp"

#include <array>
#include <map>
#include <span>
#include <vector>

/// Surfaces of a wall and how they hang together.
namespace lv::mesh {

/// The nodes of a face in ascending order, the fourth of a triangle is -1: equal for the same face
/// of two cells.
using FaceKey = std::array<int, 4>;
[[nodiscard]] FaceKey face_key(std::span<const int> face);

/// The faces that belong to one cell only, with normals out of the wall.
[[nodiscard]] Surface boundary(const Mesh& mesh);

/// Faces that belong to more than two cells: none unless cells lie on one another.
[[nodiscard]] std::vector<FaceKey> crowded_faces(const Mesh& mesh);

/// For each cell the number, from 0, of its part: cells that hang together by faces.
[[nodiscard]] std::vector<int> cell_parts(const Mesh& mesh);

/// The faces at each edge, which has its nodes in ascending order.
[[nodiscard]] std::map<std::array<int, 2>, std::vector<int>> faces_at_edges(const Surface& surface);

/// For each face the number, from 0, of its part: faces that hang together by edges.
[[nodiscard]] std::vector<int> face_parts(const Surface& surface);

/// For each edge the number, from 0, of its part: edges that hang together by nodes.
[[nodiscard]] std::vector<int> edge_parts(std::span<const std::array<int, 2>> edges);

/// The edges of one face alone, by the closed lines that they make.
[[nodiscard]] std::vector<std::vector<std::array<int, 2>>> boundary_loops(const Surface& surface);

/// Number of closed lines that the edge of the surface consists of: 0 for a sphere, 1 for a disc, 2
/// for a ring.
[[nodiscard]] int edge_loops(const Surface& surface);

/// Largest entry + 1 of a list of parts.
[[nodiscard]] int count_parts(const std::vector<int>& parts);

/// The faces whose entry in `parts` is `part`.
[[nodiscard]] Surface take_part(const Surface& surface, const std::vector<int>& parts, int part);

/// Area vector of a face, int n dA [mm^2]; exact for a bilinear quadrilateral.
[[nodiscard]] Vec3 area_vector(std::span<const Vec3> nodes, std::span<const int> face);

/// Mean of the face's nodes [mm].
[[nodiscard]] Vec3 face_centre(std::span<const Vec3> nodes, std::span<const int> face);

/// int dA, a quadrilateral as its two triangles [mm^2].
[[nodiscard]] double area(std::span<const Vec3> nodes, const Surface& surface);

/// int (x - about).n dA / 3 [mm^3]: the volume between the surface and the cone from its edge to
/// `about`, negative where normals point inwards. A quadrilateral counts as the mean of its two
/// ways to be cut into triangles, which is exact for the bilinear face.
[[nodiscard]] double signed_volume(std::span<const Vec3> nodes, const Surface& surface,
                                   const Vec3& about);

/// Calls `visit(a, b, c)` with the nodes of the triangle, or of the two halves of the
/// quadrilateral.
template <class Visit>
void for_triangles(std::span<const int> face, Visit&& visit) {
  for (std::size_t i = 2; i < face.size(); ++i)
    visit(face[0], face[i - 1], face[i]);
}

}  // namespace lv::mesh
