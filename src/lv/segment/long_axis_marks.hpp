#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/geometry/long_axis.hpp"
#include "lv/image/picture.hpp"

#include <array>
#include <optional>
#include <vector>

namespace lv::segment {

/// A point that was found in an image.
struct FoundPoint {
  Vec3 at = Vec3::Zero();   ///< image space [mm]
  double confidence = 0.0;  ///< 0 to 1
};

/// What a long-axis image shows of the ventricle's ends: nothing where it cannot be told.
struct LongAxisMarks {
  std::array<std::optional<FoundPoint>, 2> annulus;  ///< where the wall ends, on either side
  std::optional<FoundPoint> apex;                    ///< of the blood
};

/// What is known of the slices that loops lie on.
struct StackOfLoops {
  double spacing = 0.0;  ///< between slices [mm]
  double fall = 0.5;     ///< at which the loops of the endocardium were drawn, see draw_borders
};

/// Looks for the ventricle's ends on a long-axis image. The short-axis loops of the same time cut
/// its plane at points that are known; between them grey values of blood (the median of the inner
/// half of the cavity) and of muscle on either side (the median of the middle of the wall) are
/// learnt. With D = (blood - grey)/(blood - muscle), 0 in blood and 1 in muscle,
///
/// - the edge of the blood is followed, on either side of the axis, from the loops in the middle
///   over the most basal one and 2.2 slice spacings and 9 mm on, as the open path of least cost:
///   a fall from blood to muscle, little darkness within, the loops not far; within 2.5 mm of it
///   the edge lies where D passes the fall of the loops. Outside it, over two thirds
///   of the wall's thickness, the image is like muscle or not (u, 0 to 1): the wall ends at the
///   height h that makes
///
///     sum_(h - 12 mm)^h u + sum_h^(h + 8 mm) (1 - u)
///
///   least, up to 2.2 slice spacings below or above the most basal loop. Confidence: the part of the
///   rows within 8 mm on which u is less than a half below and more above.
/// - the edge of the blood round the tip is the path of least cost in a fan of rays from a point of
///   the axis 12 mm above the most apical loop, down to two slice spacings below that loop. The apex
///   is the lowest point of a parabola through its lowest 8 mm to either side. Confidence: the part
///   of the rays within 30 degrees of the axis that have blood within and muscle outside the path.
///
/// Nothing is told where fewer than three loops cut the plane round the axis, blood and muscle
/// differ by less than 0.3 of the blood, or an end lies where the search does.
[[nodiscard]] LongAxisMarks find_marks(const image::Picture& picture,
                                       const geometry::Contours& loops, const StackOfLoops& stack);

/// The direction across the axis, in the plane, in which side 1 of LongAxisMarks::annulus lies.
[[nodiscard]] Vec3 side_of(const image::Plane& plane, const geometry::LongAxis& axis);

/// The outside of the wall on the image as a polygon [image space, mm]: where the loops' epicardium
/// passes through it, from beyond the annulus on one side, round the apex, to the other. Fewer than
/// three points where the loops do not cut it.
[[nodiscard]] std::vector<Vec3> outline_of_wall(const image::Plane& plane,
                                                const geometry::Contours& loops,
                                                const LongAxisMarks& marks);

}  // namespace lv::segment
