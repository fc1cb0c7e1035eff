#include "lv/scar/wall_outlines.hpp"

#include "lv/geometry/contour_measures.hpp"
#include "lv/strain/measures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lv::scar {
namespace {

using geometry::Contour;
using geometry::Polygon;

/// The lines in which a plane cuts a side, in the plane.
std::vector<Polygon> lines_in(const Triangles& side, const image::Plane& plane) {
  std::vector<Polygon> lines;
  for (const auto& line : strain::cut(side, plane.origin, plane.normal()))
    lines.push_back(in_plane(line, plane));
  return lines;
}

bool is_closed(const Polygon& line) {
  constexpr double same = 1e-6;  // [mm]
  return (line.front() - line.back()).norm() < same;
}

/// Points of a closed line, one per ray.
using Ring = std::vector<Vec3>;

constexpr int ring_rays = 72;

/// The points of a line on rays round its middle across a normal; none if a ray misses it.
Ring ring_of(const Contour& line, const Mat3& axes) {
  const Vec3 middle = geometry::mean_of(line.points);
  Polygon flat;
  for (const Vec3& x : line.points)
    flat.emplace_back((axes.transpose() * (x - middle)).head<2>());
  Ring ring;
  for (int k = 0; k < ring_rays; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / ring_rays;
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    const double r = geometry::farthest_crossing(flat, ray);
    if (r <= 0.0)
      return {};
    ring.push_back(middle + r * (axes.leftCols<2>() * ray));
  }
  return ring;
}

double height_of(const Ring& ring, const Vec3& normal) {
  return geometry::mean_of(ring).dot(normal);
}

Ring moved(Ring ring, const Vec3& by) {
  for (Vec3& x : ring)
    x += by;
  return ring;
}

/// With the ends of the first and the last slab.
std::vector<Ring> with_ends(std::vector<Ring> rings, const Vec3& normal) {
  constexpr double alone = 5.0;  // half a slab [mm]
  const std::size_t n = rings.size();
  const auto half = [&](std::size_t end, std::size_t next) {
    const double step = height_of(rings[end], normal) - height_of(rings[next], normal);
    return 0.5 * step * normal;
  };
  const Vec3 before = n > 1 ? half(0, 1) : Vec3(-alone * normal);
  const Vec3 after = n > 1 ? half(n - 1, n - 2) : Vec3(alone * normal);
  rings.insert(rings.begin(), moved(rings.front(), before));
  rings.push_back(moved(rings.back(), after));
  return rings;
}

}  // namespace

Polygon in_plane(const std::vector<Vec3>& line, const image::Plane& plane) {
  Polygon points;
  for (const Vec3& x : line)
    points.emplace_back((x - plane.origin).dot(plane.along_row),
                        (x - plane.origin).dot(plane.along_column));
  return points;
}

std::optional<WallOutlines> wall_outlines(const Triangles& endo, const Triangles& epi,
                                          const image::Plane& plane) {
  const std::vector<Polygon> inner = lines_in(endo, plane);
  const std::vector<Polygon> outer = lines_in(epi, plane);
  if (outer.size() != 1 || inner.size() > 1 || !is_closed(outer.front()) ||
      (!inner.empty() && !is_closed(inner.front())))
    return {};
  return WallOutlines{inner.empty() ? Polygon{} : inner.front(), outer.front()};
}

int part_at(const WallOutlines& lines, const Eigen::Vector2d& x) {
  if (!geometry::encloses(lines.epi, x))
    return 2;
  return !lines.endo.empty() && geometry::encloses(lines.endo, x) ? 0 : 1;
}

Triangles surface_through(const std::vector<Contour>& lines, geometry::Side side) {
  constexpr std::size_t fewest_points = 3;
  std::vector<Ring> rings;
  std::optional<geometry::Frame> plane;
  for (const Contour& line : lines) {
    if (line.side != side || line.points.size() < fewest_points)
      continue;
    if (!plane)
      plane = geometry::plane_of(line.points);
    if (Ring ring = ring_of(line, plane->axes); !ring.empty())
      rings.push_back(std::move(ring));
  }
  if (rings.empty())
    return {};
  const Vec3 normal = plane->axes.col(2);
  std::sort(rings.begin(), rings.end(), [&](const Ring& a, const Ring& b) {
    return height_of(a, normal) < height_of(b, normal);
  });
  rings = with_ends(std::move(rings), normal);
  Triangles triangles;
  for (std::size_t s = 1; s < rings.size(); ++s)
    for (std::size_t k = 0; k < ring_rays; ++k) {
      const std::size_t next = (k + 1) % ring_rays;
      triangles.push_back({rings[s - 1][k], rings[s - 1][next], rings[s][k]});
      triangles.push_back({rings[s - 1][next], rings[s][next], rings[s][k]});
    }
  return triangles;
}

}  // namespace lv::scar
