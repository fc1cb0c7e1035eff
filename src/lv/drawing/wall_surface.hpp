#pragma once

#include "lv/drawing/scene.hpp"
#include "lv/mesh/mesh.hpp"

#include <span>
#include <type_traits>
#include <vector>

namespace lv::drawing {

/// A point on the straight line between two nodes of a mesh: (1 - w) a + w b.
struct Between {
  int a, b;
  double w;
};

/// A surface in the mesh, cut into triangles whose outlines are the edges of elements. It knows
/// where its points and triangles come from, so that any field of the mesh can be painted on it.
struct WallPatch {
  Patch patch;
  std::vector<Between> origins;  ///< of each point
  std::vector<int> cells;        ///< of each triangle

  /// A nodal field (of numbers or vectors) at the patch's points.
  template <class Field>
  [[nodiscard]] auto at_points(const Field& nodal) const {
    std::vector<std::decay_t<decltype(nodal[0])>> values;
    for (const Between& o : origins)
      values.push_back((1.0 - o.w) * nodal[o.a] + o.w * nodal[o.b]);
    return values;
  }
};

/// One side of the wall (`mesh.endo`, `mesh.epi` or `mesh.base`) with the nodes at `positions`; so
/// many consecutive faces are outlined as one.
[[nodiscard]] WallPatch wall_surface(const mesh::Mesh& mesh, std::span<const Vec3> positions,
                                     const mesh::Surface& side, int outlined_together = 1);

/// The wall's section by a plane, one convex polygon per cell that the plane crosses. Neighbouring
/// polygons share their corners, which lie on edges of the mesh, so the section has no gaps.
/// So many consecutive cells are outlined as one.
[[nodiscard]] WallPatch wall_section(const mesh::Mesh& mesh, std::span<const Vec3> positions,
                                     const Plane& plane, int outlined_together = 1);

}  // namespace lv::drawing
