#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/geometry/polygon.hpp"
#include "lv/image/picture.hpp"

#include <array>
#include <optional>
#include <vector>

namespace lv::scar {

/// Corners of the triangles of a surface.
using Triangles = std::vector<std::array<Vec3, 3>>;

/// The wall's outlines in a plane, in mm along its rows and columns from its first pixel; `endo` is
/// empty below the cavity.
struct WallOutlines {
  geometry::Polygon endo, epi;
};

/// A line in mm along a plane's rows and columns from its first pixel.
[[nodiscard]] geometry::Polygon in_plane(const std::vector<Vec3>& line, const image::Plane& plane);

/// The outlines in which a plane cuts both sides of a wall. None where it misses the wall or cuts
/// it open, at the base.
[[nodiscard]] std::optional<WallOutlines> wall_outlines(const Triangles& endo, const Triangles& epi,
                                                        const image::Plane& plane);

/// 0 cavity, 1 wall, 2 surroundings.
[[nodiscard]] int part_at(const WallOutlines& lines, const Eigen::Vector2d& x);

/// The surface through the closed lines of a side on parallel slices: on 72 rays round the middle
/// of each line straight from line to line, and upright from the first and the last one half the
/// way to where the next would be (of a single line 5 mm), for a slice stands for a slab. Lines
/// that a ray from their middle does not cross are left out.
[[nodiscard]] Triangles surface_through(const std::vector<geometry::Contour>& lines,
                                        geometry::Side side);

}  // namespace lv::scar
