#pragma once

#include "lv/case_file/case.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/image/picture.hpp"
#include "lv/strain/track.hpp"

#include <map>
#include <string>
#include <vector>

namespace lv::cine {

/// A long-axis cine and the wall drawn on it at end-diastole.
struct LongAxisView {
  image::Cine cine;
  geometry::Contour endo, epi;
};

/// A case's short-axis cine and what is drawn on it.
struct CineStudy {
  image::Cine cine;
  geometry::Contours drawn;                 ///< at end-diastole
  std::vector<geometry::Contour> systolic;  ///< at end-systole, for comparison; may be empty
  std::vector<std::size_t> slice_of;        ///< the cine's slice of each of drawn.short_axis
  std::vector<LongAxisView> long_axis;
  std::map<int, Vec3> shift_of;  ///< how slices would move to agree with the long axes [mm]
  strain::Orientation orientation;
  double spacing = 0.0;  ///< between slices [mm]
  std::vector<std::string> notes;
};

/// Reads what [strain] names. Throws InputError where images and contours do not fit together.
[[nodiscard]] CineStudy read_cine_study(const case_file::Case& c);

/// Index of the cine's images that was drawn on.
[[nodiscard]] std::size_t drawn_frame(const case_file::Case& c, const image::CineSlice& slice);

/// The slices that have both loops, ready to be followed; the study must outlive them.
[[nodiscard]] std::vector<strain::SliceTask> slice_tasks(const case_file::Case& c,
                                                         const CineStudy& study);

}  // namespace lv::cine
