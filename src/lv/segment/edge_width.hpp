#pragma once

#include "lv/segment/polar.hpp"

#include <vector>

/// How far from blood to muscle the grey value has come at the endocardium, from how wide the edges
/// are.
///
/// A smooth wall's edge is as wide as the image is sharp, and the endocardium lies in its middle:
/// at 0.5 of the way from blood to muscle. Trabeculae, which belong to the cavity, make it wider:
/// from blood alone the muscle grows more and more until it is all, and there, at the outer end,
/// observers draw the endocardium. Taken as a linear ramp of the width d, seen through a Gaussian
/// point spread of the deviation sigma, the darkness (0 blood, 1 muscle) at a distance x outside
/// the border is
///
///   D(x) = Phi(x/sigma) + int_0^d (1 - u/d) phi((x + u)/sigma) du/sigma,
///
/// and both the width of the edge and D(0), the darkness at the border, follow from d/sigma.
namespace lv::segment {

/// The width of an edge is the distance from this darkness to that.
inline constexpr double edge_begins = 0.5, edge_ends = 0.85;

/// The width of the edge along each ray [mm] of a picture of darkness, the nearest inside a line in
/// the wall; negative where there is none.
[[nodiscard]] Radii edge_widths(const Polar& darkness, const Radii& wall, const PolarGrid& grid);

/// The width of an edge [mm] without trabeculae: of a Gaussian with the variance of a pixel's area,
/// of linear interpolation between pixels, of the polar picture's smoothing, and of a wall that
/// leans by `slope` (radius per height) in slices as thick as they are apart.
[[nodiscard]] double sharp_width(const image::Plane& plane, const PolarGrid& grid, double slope,
                                 double spacing);

/// What the widths of a study's edges tell of the darkness at the border.
struct BorderDarkness {
  double likely = edge_begins;    ///< pictures are as sharp as their sharpest edges
  double if_sharp = edge_begins;  ///< pictures are as sharp as their pixels
};

/// The darkness at the border from the widths of a study's edges, each divided by its sharp_width.
///
/// Pictures may be less sharp than their pixels: the sharpest tenth of the edges, known to be 0.77
/// times as wide as the median where no edge has trabeculae (measured on phantoms), is taken for
/// sharp; trabeculae all round would be taken for blur, which if_sharp has the other way round.
/// What the median is wider counts for a ramp, but for a fifth of the variance, by which
/// edges without trabeculae come out wider too (also measured). At most 0.95; 0.5 without edges.
[[nodiscard]] BorderDarkness darkness_at_border(std::vector<double> widths);

}  // namespace lv::segment
