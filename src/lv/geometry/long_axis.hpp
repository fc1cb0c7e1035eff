#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/geometry/frame.hpp"
#include "lv/geometry/parameters.hpp"

#include <vector>

namespace lv::geometry {

/// Numbers of the short-axis slices from the base to the apex. The apex is on the side of the apex
/// points, else of the long-axis curves' tips, else of the end slice with the smaller endocardium.
[[nodiscard]] std::vector<int> slices_from_base(const Contours& contours);

/// The long axis in image space: a point on it and its direction towards the base.
struct LongAxis {
  Vec3 point, up;
};

/// The straight line of least squares through the centres (the means of the points) of all
/// endocardial loops and, if it is shown, the endocardial apex. All of them together, so that one
/// slice drawn out of place or one uncertain apex does not turn the axis. Where that line leaves a
/// loop (a ventricle whose apex is bent), the centres count by the inverse squares of their loops'
/// radii, so that the axis keeps to the small loops and uses the room in the large ones.
[[nodiscard]] LongAxis long_axis(const Contours& contours);

/// The endocardial apex in image space: the mean of its apex points, else of the tips of its
/// long-axis curves (the point farthest from the chord between a curve's ends), else the point of
/// the long axis that extrapolated_depth says.
[[nodiscard]] Vec3 endo_apex(const Contours& contours);

/// Whether apex points or long-axis curves show the apex of a surface.
[[nodiscard]] bool shows_apex(const Contours& contours, Side side);

/// How far beyond the last loop of a surface the squared mean radius r^2 of its last two loops
/// would vanish linearly [mm]; infinity where it does not fall.
[[nodiscard]] double vanishing_depth(const Contours& contours, Side side);

/// How far the apex of a surface lies beyond its last loop if nothing shows it [mm]:
/// vanishing_depth, but not farther than one slice spacing, for the next slice showed nothing of
/// it.
[[nodiscard]] double extrapolated_depth(const Contours& contours, Side side);

/// The loops of a surface from the base to the apex.
[[nodiscard]] std::vector<const Contour*> loops_from_base(const Contours& contours, Side side);

/// The usual distance of neighbouring endocardial loops along their normal: the median [mm].
[[nodiscard]] double slice_spacing(const Contours& contours);

/// From the centre of the most basal endocardial loop to the end of the slab that it stands for:
/// half a slice spacing along its normal, away from the apex [mm].
[[nodiscard]] Vec3 basal_slab(const Contours& contours);

/// The model frame of some contours: z = 0 is the base plane, whose height is as BaseAt says. If it
/// holds the centre of the most basal endocardial loop:
///
///   BasePlane::long_axis     z is the direction of the long axis, the origin is on it;
///   BasePlane::basal_slice   z is normal to the plane of the most basal endocardial loop, the
///                            origin is the loop's centre: the rule of the published GlasgowHeart
///                            geometries, whose basal loop is drawn in the plane of the valves.
///
/// x points, as seen along z, from the origin to the septum point; else from the centre of the most
/// basal loop to its first point. @throws InputError if the septum point is on the long axis, or if
/// the base plane shall lie in an annulus that nothing shows.
[[nodiscard]] Frame model_frame(const Contours& contours, const FrameParameters& parameters);

}  // namespace lv::geometry
