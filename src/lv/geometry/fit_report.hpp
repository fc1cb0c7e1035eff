#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/geometry/frame.hpp"
#include "lv/geometry/star_surface.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lv::geometry {

/// Distances of contour points from the fitted surface in space [mm].
struct Residual {
  int points = 0;
  double mean = 0.0, rms = 0.0, max = 0.0;
};

/// How the surfaces meet the contours of one image; long-axis contours up to the margin above the
/// base.
struct ImageReport {
  int slice = 0;
  std::optional<Residual> endo, epi;
  std::optional<double> endo_area, epi_area;  ///< that the loops of a slice enclose [mm^2]
  Vec3 shift = Vec3::Zero();  ///< by which a short-axis slice was moved, image space [mm]
};

/// A thickness of the wall: from a point of the endocardium to the nearest of the epicardium.
struct Thickness {
  double value = 0.0;      ///< [mm]; negative where the surfaces have crossed
  Vec3 at = Vec3::Zero();  ///< the point of the endocardium, model frame [mm]
  int slice = 0;           ///< the nearest short-axis slice
};

/// A part of the anatomy that nothing shows ("apex", "base", "septum", "early diastole"), and what
/// was taken for it.
struct Assumption {
  std::string part, text;
};

struct FitReport {
  std::vector<ImageReport> short_axis;  ///< from the base to the apex
  std::vector<ImageReport> long_axis;
  std::optional<Residual> apex_endo, apex_epi;
  double volume_cavity = 0.0;  ///< below the basal plane [mm^3]
  double volume_wall = 0.0;    ///< below the basal plane [mm^3]
  /// Area times slab thickness of the endocardial loops, and of what lies between them and the
  /// epicardial ones where a slice has one (see slab_volumes) [mm^3].
  double contour_cavity = 0.0, contour_wall = 0.0;
  int wall_slices = 0;         ///< with an epicardium
  double slice_spacing = 0.0;  ///< [mm]
  double base_height = 0.0;    ///< of the base plane above the most basal endo loop's centre [mm]
  Thickness thinnest, thickest;
  double slice_tilt = 0.0;         ///< between the long axis and the basal slice's normal [radians]
  std::vector<std::string> notes;  ///< what was assumed or extrapolated
  std::vector<Assumption> assumed;  ///< of these, what is said of the apex and the base
};

/// Volumes by adding slabs: area of a slice times the thickness of the slab that it stands for,
/// which reaches half way to its neighbours, and beyond the first and last slice half the usual
/// spacing.
struct SlabVolumes {
  double cavity = 0.0;  ///< of all endocardial loops [mm^3]
  double wall = 0.0;    ///< between epicardium and endocardium, of slices with an epicardium [mm^3]
  int wall_slices = 0;  ///< how many have one
};
[[nodiscard]] SlabVolumes slab_volumes(const Contours& contours);

/// Measures two surfaces against the contours they were fitted to. `margin` [mm]: how far above the
/// base contours count. Shifts and notes are left empty.
[[nodiscard]] FitReport measure_fit(const Contours& contours, const Frame& frame,
                                    const StarSurface& endo, const StarSurface& epi, double margin);

}  // namespace lv::geometry
