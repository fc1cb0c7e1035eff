#pragma once

#include "lv/mesh/mesh.hpp"

#include <string>
#include <vector>

namespace lv::mesh_io {

/// A surface of triangles in image space (LPS) [mm]; points in the same place are one, and
/// triangles with two corners in one place are left out.
struct Triangles {
  std::string file;  ///< for messages
  std::vector<Vec3> nodes;
  mesh::Surface faces{.nodes_per_face = 3, .nodes = {}};
};

/// What a file says of the space of its coordinates: "RAS", "LPS", or nothing. Throws InputError
/// where it cannot be read, or says another space.
[[nodiscard]] std::string stated_space(const std::string& file);

/// Reads polygons from .stl, .ply, .obj, .vtp or a legacy .vtk file as triangles. `unit` is the
/// length of the file's unit [mm]; `space`, "LPS" or "RAS", that of a file that does not state its
/// own. Throws InputError where the file cannot be read, holds no polygons or a point that is no
/// place.
[[nodiscard]] Triangles read_triangles(const std::string& file, double unit,
                                       const std::string& space);

}  // namespace lv::mesh_io
