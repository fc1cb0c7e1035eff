#pragma once

#include "lv/geometry/contours.hpp"
#include "lv/image/picture.hpp"
#include "lv/strain/segments.hpp"
#include "lv/strain/warp.hpp"

#include <vector>

namespace lv::strain {

/// What is known of the heart in all slices.
struct Orientation {
  Vec3 up = Vec3::UnitZ();     ///< along the long axis towards the base
  Vec3 septum = Vec3::Zero();  ///< a point of the middle of the septum [mm]
  Vec3 base = Vec3::Zero();    ///< a point of the base plane
  Vec3 apex = Vec3::Zero();    ///< of the endocardium
};

/// A slice to be followed: its cine and the two loops drawn on one of its images.
struct SliceTask {
  const image::CineSlice* cine = nullptr;
  std::vector<int> phases;  ///< numbers of the cine's images, from 1
  int drawn = 0;            ///< index of the image with the loops
  geometry::Contour endo, epi;
};

/// A slice that was followed.
struct TrackedSlice {
  SliceSeries series;                        ///< from the image with the loops on, around the cycle
  std::vector<Match> matches;                ///< one per phase
  std::vector<double> cavity_areas;          ///< inside the endocardium carried along [mm^2]
  std::vector<geometry::Contour> endo, epi;  ///< carried along, image space, one per phase
  double smallest_J = 1.0;                   ///< of the wall's area anywhere, at any phase
};

/// Follows a slice's wall. Images before the one with the loops come after the last, as the cycle
/// repeats. Throws InputError if a loop does not lie on its image or is not star-shaped about the
/// cavity's middle.
[[nodiscard]] TrackedSlice track(const SliceTask& task, const Orientation& orientation,
                                 const RegistrationParameters& parameters);

/// Follows several slices, on all cores.
[[nodiscard]] std::vector<TrackedSlice> track(const std::vector<SliceTask>& tasks,
                                              const Orientation& orientation,
                                              const RegistrationParameters& parameters);

/// Area enclosed by a flat loop [mm^2].
[[nodiscard]] double loop_area(const std::vector<Vec3>& loop);

}  // namespace lv::strain
