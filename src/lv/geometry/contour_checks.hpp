#pragma once

#include "lv/geometry/contours.hpp"

#include <string>
#include <vector>

namespace lv::geometry {

/// Refuses contours that cannot be borders of one left ventricle, by file and line: fewer than 8
/// points in a loop (5 in a long-axis curve) or fewer than 3 slices; a size of both borders that
/// only another unit than mm explains; loops that are not flat, not closed or cross themselves; a
/// slice without endocardium, unless it lies beyond the cavity at the apex; a single epicardium,
/// where no long-axis curve shows it besides; an endocardium that crosses, encloses or lies beside
/// its epicardium; slices that are not parallel, not in order, or share a plane; long-axis curves
/// or apex points far from the slices; long-axis curves that pass the loops more than 20 mm beside
/// them (the median of where they cross the slices' planes). A slice without epicardium is
/// accepted. @throws InputError
void check_contours(const Contours& contours);

/// What keeps the closed lines of a slice from being borders of one wall.
struct SliceFault {
  int slice = 0;
  std::string what;  ///< "the endocardium crosses itself"
};

/// Loops that cross themselves, and endocardia that cross, enclose or lie beside the epicardium of
/// their slice: what check_contours refuses of single slices, which need not be a whole ventricle's
/// yet.
[[nodiscard]] std::vector<SliceFault> slice_faults(const std::vector<Contour>& loops);

/// Slices (of endocardial loops) that lie much farther apart than usual, the usual distance being
/// the median: some between them may be missing. Where a wide step and a narrow one beside it are
/// together two usual ones, the slice between both seems misplaced.
[[nodiscard]] std::vector<std::string> notes_on_spacing(const Contours& contours);

/// Loops of which a fifth of the length or more lies between two neighbouring points, though others
/// lie much closer: a part was not drawn, and is bridged. At most one note.
[[nodiscard]] std::vector<std::string> notes_on_gaps(const Contours& contours);

/// The cavity of a slice that shows a ventricle's tip, as a part of the largest slice's area.
inline constexpr double largest_tip = 0.4;

/// A warning where the last slice towards the apex holds more than a tip (largest_tip) and neither
/// a slice with muscle alone, a point of the apex nor a long-axis curve shows where the cavity
/// ends: slices of the tip are missing. Empty otherwise.
[[nodiscard]] std::string hidden_tip(const Contours& contours);

}  // namespace lv::geometry
