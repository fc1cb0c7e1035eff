#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/geometry/fit_report.hpp"
#include "lv/geometry/frame.hpp"
#include "lv/geometry/meridian_map.hpp"
#include "lv/geometry/parameters.hpp"

#include <vector>

namespace lv::geometry {

/// The wall of the left ventricle between two spline surfaces, in the model frame: z along the long
/// axis, base plane z = 0, apex at negative z [mm].
class SplineWall {
 public:
  SplineWall(const Frame& frame, MeridianMaps maps, FitReport report);

  /// The point at fraction u of the way from the apex (0) to the base plane (1), angle theta about
  /// the long axis (anticlockwise seen from the base) and depth t (0 endocardium, 1 epicardium;
  /// linear between). At u = 1 z is exactly 0.
  [[nodiscard]] Vec3 point(double u, double theta, double t) const;

  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] const StarSurface& endo() const { return maps_.endo.surface(); }
  [[nodiscard]] const StarSurface& epi() const { return maps_.epi.surface(); }
  [[nodiscard]] const FitReport& report() const { return report_; }

 private:
  Frame frame_;
  MeridianMaps maps_;
  FitReport report_;
};

/// Whether a fit moves slices in their planes: with contours of two or more long-axis images unless
/// correct_shifts is off, without them if align_slices is on.
[[nodiscard]] bool moves_slices(const Contours& contours, const SplineFitParameters& parameters);

/// How the slices, from base to apex, have to move in their planes to agree with the contours of
/// two or more long-axis images, or without these and with align_slices to make the wall smooth
/// [mm, image space]; zero where neither is given. They are the shifts that fit_surfaces finds.
/// @throws InputError if one is larger than the largest shift.
[[nodiscard]] std::vector<Vec3> slice_shifts(const Contours& contours,
                                             const SplineFitParameters& parameters);

/// Fits the wall to contours that check_contours accepts: the frame by model_frame, the surfaces by
/// fit_surfaces. With contours of two or more long-axis images the slices are first moved in their
/// planes until they agree with them (different breath-holds), and the frame is laid again. Points
/// of long-axis contours count up to the margin above the base plane.
///
/// What no contour shows is assumed, and noted in the report: the endocardial apex as endo_apex
/// says; the epicardial apex as far below the endocardial one as the wall is thick in the most
/// apical slice that shows both, or, where slices beyond the cavity show muscle alone, beyond the
/// last of them as extrapolated_depth says. With BaseAt::slab the most basal loops are repeated
/// where their slab ends, half a slice spacing above them.
///
/// @throws InputError naming slice, height and angle if a contour is folded as seen from the long
/// axis, a slice is moved by more than the largest shift, the wall is thinner than the thinnest
/// wall, its surfaces cross, or the map (t, theta, u) -> x (nearly) turns inside out, which no
/// mesh could follow.
[[nodiscard]] SplineWall fit_spline_wall(const Contours& contours,
                                         const SplineFitParameters& parameters);

}  // namespace lv::geometry
