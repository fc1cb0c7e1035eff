#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/image/volume.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lv::image {

/// Which labels mean what.
struct LabelMeaning {
  std::vector<int> cavity;           ///< blood of the left ventricle, with papillary muscles or not
  std::vector<int> muscle;           ///< of the left ventricle
  std::vector<int> right_ventricle;  ///< its blood; may be empty
};

/// The borders of a labelled ventricle at one time.
struct LabelContours {
  geometry::Contours contours;                  ///< slices counted from 1 along the slice axis
  double cavity = 0.0;                          ///< volume of all voxels of the cavity [mm^3]
  double muscle = 0.0;                          ///< volume of all voxels of the muscle [mm^3]
  std::optional<std::array<double, 3>> septum;  ///< towards the middle of the right ventricle [mm]
  std::vector<std::string> notes;               ///< what was filled, dropped, or left out, by slice
  std::string alike;     ///< a warning of neighbouring slices that are the same; or empty
  std::string cut_base;  ///< a warning of much of the cavity in slices left out; or empty
};

/// Draws the borders on every slice across slice_axis, half way between pixels inside and outside
/// (see outline): the endocardium around the cavity, the epicardium around cavity and muscle.
///
/// - Slices that a base tilted to them cuts are first made whole or left out: see mend_cut_base.
///   More than a twentieth of the cavity's voxels left out is warned of.
/// - Muscle or other labels that the cavity encloses count to the cavity (papillary muscles); more
///   than 30% of a slice is refused, for then the labels seem swapped.
/// - Of several parts the largest is taken and the rest dropped; a second part of 20% or more is
///   refused, unless the largest is too small for a border.
/// - Holes of the wall count to it, with a note. They are refused where they hold more than half of
///   the right ventricle of a slice (and more than a twentieth of the cavity), or a fifth of all
///   within the epicardium.
/// - Where the muscle is open on part of a slice the loops touch or cross: see close_walls.
/// - A gap of one slice in the cavity is left to the fit; behind a wider one parts of less than 20%
///   of the cavity are dropped, larger ones refused.
/// - A map of small voxels whose slices lie askew to the long axis is first resampled: see
///   on_short_axis. Otherwise slices whose normal lies more than 25 degrees from the long axis of
///   the cavity are refused, more than 15 noted. The long axis is then the principal axis of the
///   cavity's pixels, each slice moved onto the line that the middles of most follow, if their standard deviation along it is 1.25 times the next one and the next
///   is nearer to the third.
/// - A wall that reaches the edge of the image is noted.
/// - Slices with muscle alone count beyond the apex (the end with the smaller cavity), next to it;
///   elsewhere they are left out.
/// - Neighbouring slices with cavity and muscle that are the same, voxel for voxel, are warned of
///   where they are at least 3 mm apart and few: no more than a quarter of all such neighbours, or
///   one pair. Where more are, the map was resampled from thicker slices, which a note says.
///
/// Throws InputError naming the file and the slice; the labels must be in the frame (see
/// require_labels).
[[nodiscard]] LabelContours trace_labels(const Volume& volume, const LabelMeaning& meaning,
                                         int frame);

/// The volume of the cavity's voxels at every time [mm^3].
[[nodiscard]] std::vector<double> volume_curve(const Volume& volume,
                                               const std::vector<int>& cavity);

/// Phases proposed from a volume curve, counted from 0, among the frames that show any volume:
/// end-diastole at the largest, end-systole at the smallest, early diastole at the first time after
/// it (going round) and before end-diastole at which the volume has grown by a tenth of the stroke
/// volume; end-systole again where no frame shows that.
struct Phases {
  int end_diastole = 0, end_systole = 0, early_diastole = 0;
};
[[nodiscard]] Phases propose_phases(const std::vector<double>& volumes);

}  // namespace lv::image
