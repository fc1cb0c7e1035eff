#pragma once

#include "lv/mesh/mesh.hpp"

#include <memory>
#include <span>

namespace lv::mesh {

/// Between the same nodes of two walls, the largest [mm].
[[nodiscard]] double largest_distance(std::span<const Vec3> a, std::span<const Vec3> b);

/// Exact distance to a surface of triangles; quadrilaterals count as their two triangles. An R-tree
/// over the triangles makes each query logarithmic in their number.
class SurfaceDistance {
 public:
  SurfaceDistance(std::span<const Vec3> nodes, const Surface& surface);
  ~SurfaceDistance();
  SurfaceDistance(SurfaceDistance&&) noexcept;
  SurfaceDistance& operator=(SurfaceDistance&&) noexcept;

  /// min |x - y| over the points y of the surface [mm]
  [[nodiscard]] double operator()(const Vec3& x) const;
  /// The same, negative where x lies behind the surface: its normals point away from x [mm].
  [[nodiscard]] double signed_distance(const Vec3& x) const;

 private:
  class Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace lv::mesh
