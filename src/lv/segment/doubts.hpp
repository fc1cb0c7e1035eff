#pragma once

#include "lv/segment/segment.hpp"

#include <string>
#include <vector>

namespace lv::segment {

/// Throws InputError, with `where` naming the images, if end-systole holds more than end-diastole:
/// moments are those of the slices that always show the ventricle, and where the others turn them
/// round the borders are no ventricle's.
void require_emptying(const Segmentation& found, const std::string& where,
                      const std::string& remedy);

/// What an observer should look at in borders that were drawn, in sentences: a slice that lies 8 mm
/// off those beside it, borders of little confidence, volumes that hang on them, fluid outside the
/// muscle, a wall above 15 mm at end-diastole, and papillary muscles that are within the
/// endocardium at end-diastole and by a tenth of the end-systolic volume less at end-systole, and
/// an end-systolic cavity of which half a pixel all round is 15% or more.
/// `slices` are those that show the ventricle, from its base to its tip.
[[nodiscard]] std::vector<std::string> doubts_of_drawn(const image::Cine& cine,
                                                       const std::vector<std::size_t>& slices,
                                                       const Segmentation& found);

/// What makes volumes, masses or moments wrong, however sure the borders are:
///
/// - ends: a stack of images that ends at the most basal slice, or at a most apical one whose
///   cavity is no tip's;
/// - the image's edge: a border that runs along it or beyond;
/// - muscle, which keeps its volume over a beat (a few per cent of blood apart): phases, and
///   moments, that differ from end-diastole by more than 15%, and half of a slice at the base more
///   where one shows the ventricle in one of both alone;
/// - motion: a volume that changes by less than 5%; a cine that ends with end-systole.
[[nodiscard]] std::vector<std::string> warnings_of_drawn(const image::Cine& cine,
                                                         const std::vector<std::size_t>& slices,
                                                         const Segmentation& found);

}  // namespace lv::segment
