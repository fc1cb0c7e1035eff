#pragma once

#include <array>
#include <optional>

namespace lv::geometry {

/// The direction of the base plane z = 0. It is
enum class BasePlane {
  long_axis,   ///< normal to the long axis
  basal_slice  ///< the plane of that loop
};

/// Where the base plane lies.
enum class BaseAt {
  slice,   ///< in the centre of the most basal endocardial loop
  slab,    ///< half a slice spacing above it, where the slab ends that the slice stands for
  annulus  ///< in the mean of the points of the mitral annulus, else of the ends of the long-axis
           ///< curves of the endocardium
};

/// How the model frame is laid into the contours.
struct FrameParameters {
  BasePlane base_plane = BasePlane::long_axis;
  /// A point of the septum in image space [mm]: the direction of x, theta = 0.
  std::optional<std::array<double, 3>> septum;
  BaseAt base_at = BaseAt::slice;
};

/// How the two surfaces are fitted to the contours.
///
/// The smoothing length is what predicts best a slice that the fit was not shown. For slices 10 mm
/// apart that minimum is flat: of a real ventricle, the loops left out lay 1.5 mm (root mean
/// square) from the fit at 3 to 5 mm, 1.55 at 2 and 6 mm. Shorter ones follow the noise and
/// let contours that contradict each other thin the wall; longer ones flatten the base and lose
/// cavity.
struct SplineFitParameters {
  FrameParameters frame;
  int around = 16;                ///< spline intervals about the long axis
  int along = 12;                 ///< spline intervals from the apex to above the base
  double smoothing_length = 5.0;  ///< l [mm]: a ripple of wave length 2 pi l is halved; 0: none
  double margin = 5.0;            ///< contour points up to this height above the base count [mm]
  bool correct_shifts = true;     ///< move slices in their planes if there are long-axis contours
  double largest_shift = 15.0;    ///< of a slice [mm]
  double thinnest_wall = 1.0;     ///< that is accepted [mm]; scarred apexes have 1.5 and less
};

}  // namespace lv::geometry
