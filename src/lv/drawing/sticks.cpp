#include "lv/drawing/sticks.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace lv::drawing {
namespace {

void add_tube(Patch& patch, const Segment& segment, double radius) {
  const Vec3 along = (segment.b - segment.a).normalized();
  const Vec3 x = along.unitOrthogonal();
  const Vec3 y = along.cross(x);
  const int first = static_cast<int>(patch.points.size());
  for (int i = 0; i < tube_sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / tube_sides;
    const Vec3 arm = radius * (std::cos(angle) * x + std::sin(angle) * y);
    patch.points.emplace_back(segment.a + arm);
    patch.points.emplace_back(segment.b + arm);
  }
  const auto begin = [&](int i) { return first + 2 * (i % tube_sides); };
  const auto end = [&](int i) { return begin(i) + 1; };
  for (int i = 0; i < tube_sides; ++i) {
    patch.triangles.push_back({begin(i), begin(i + 1), end(i + 1)});
    patch.triangles.push_back({begin(i), end(i + 1), end(i)});
  }
  for (int i = 1; i + 1 < tube_sides; ++i) {
    patch.triangles.push_back({begin(0), begin(i + 1), begin(i)});
    patch.triangles.push_back({end(0), end(i), end(i + 1)});
  }
}

}  // namespace

std::vector<Segment> sticks(std::span<const Vec3> points, std::span<const Vec3> directions,
                            double length) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 half = 0.5 * length * directions[i].normalized();
    segments.push_back({points[i] - half, points[i] + half});
  }
  return segments;
}

Patch tubes(std::span<const Segment> segments, double radius) {
  Patch patch;
  for (const Segment& segment : segments)
    add_tube(patch, segment, radius);
  return patch;
}

FaceColours tube_colours(std::span<const std::optional<Colour>> per_segment) {
  FaceColours colours;
  for (const auto& colour : per_segment)
    colours.insert(colours.end(), tube_triangles, colour);
  return colours;
}

}  // namespace lv::drawing
