#pragma once

#include "lv/base/bounds.hpp"
#include "lv/mesh/mesh.hpp"

#include <string>
#include <vector>

namespace lv::mesh_io {

/// A closed surface of triangles, or several, and what they enclose.
class ClosedSurface {
 public:
  /// Throws InputError, naming `where`, if there are no triangles or they do not close: every edge
  /// must be run through as often one way as the other. Normals may point in or out.
  ClosedSurface(std::vector<Vec3> nodes, mesh::Surface triangles, const std::string& where);

  /// Whether the surface winds around x. With the solid angles Omega of its triangles seen from x
  /// (A. van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30:125, 1983) the winding number is
  /// sum Omega / 4 pi; rounding off cannot change which whole number it is near.
  [[nodiscard]] bool contains(const Vec3& x) const;

  /// The box around it.
  [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_; }

 private:
  std::vector<Vec3> nodes_;
  mesh::Surface triangles_;
  Eigen::AlignedBox3d box_;
};

/// Reads polygons from .stl, .ply, .obj, .vtp or a legacy .vtk file; points in the same place are
/// one. `unit` is the length of the file's unit [mm]. Points of a file that says SPACE=RAS are
/// turned to LPS (stated_space.hpp). Throws InputError where the file cannot be read or the surface
/// is not closed.
[[nodiscard]] ClosedSurface read_closed_surface(const std::string& file, double unit);

}  // namespace lv::mesh_io
