#pragma once

#include "lv/drawing/scene.hpp"

#include <span>
#include <vector>

namespace lv::drawing {

/// A straight line from a to b [mm].
struct Segment {
  Vec3 a, b;
};

/// Sticks of the given length [mm] along directions (their sign is of no account), each centred at
/// its point: fibres.
[[nodiscard]] std::vector<Segment> sticks(std::span<const Vec3> points,
                                          std::span<const Vec3> directions, double length);

/// Segments as closed prisms that look round; every segment has `tube_triangles` triangles.
[[nodiscard]] Patch tubes(std::span<const Segment> segments, double radius);
inline constexpr int tube_sides = 8;
inline constexpr int tube_triangles = 4 * tube_sides - 4;

/// One colour per segment as colours of its triangles.
[[nodiscard]] FaceColours tube_colours(std::span<const std::optional<Colour>> per_segment);

}  // namespace lv::drawing
