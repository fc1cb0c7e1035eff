#pragma once

#include "lv/base/table.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/image/picture.hpp"
#include "lv/scar/wall_outlines.hpp"

#include <filesystem>
#include <optional>
#include <vector>

/// Scar, pixel by pixel of a late-enhancement image.
namespace lv::scar {

/// What is at a pixel. Remote muscle is what an observer showed to be healthy.
enum class Tissue : char { outside, muscle, remote, scar };

/// The pixels of a slice, row by row, and who says so.
struct SliceMap {
  std::vector<Tissue> pixels;
  geometry::Provenance drawn;
};

/// The wall as a late-enhancement image shows it, slice by slice.
struct ScarMap {
  std::vector<SliceMap> slices;
  double threshold = 0.0;  ///< grey value from which on muscle was proposed as scar
  int phase = 0;           ///< of the cine, from 1, whose borders show the wall
};

/// A piece of a row of alike pixels, counted from 0.
struct Run {
  int row, first, last;
  Tissue tissue;
};

/// The runs of the wall's pixels, row by row.
[[nodiscard]] std::vector<Run> runs_of(const std::vector<Tissue>& pixels,
                                       const image::Plane& plane);

/// part_at of the middle of every pixel, row by row; without outlines all are surroundings.
[[nodiscard]] std::vector<char> parts_of(const image::Plane& plane,
                                         const std::optional<WallOutlines>& lines);

/// Of every pixel of the wall (part 1 of parts_of) whether it is brighter than a threshold. With
/// `fill`, what the bright ones shut off from the epicardium counts too: parts of the rest of the
/// wall, hanging together across the sides of pixels, that are not its largest and border no
/// surroundings (the dark core of a scar).
[[nodiscard]] std::vector<char> brighter(const image::Picture& picture,
                                         const std::vector<char>& parts, double threshold,
                                         bool fill);

/// A row for every run of alike pixels of the wall:
///
///   slice,tissue,row,first,last      counted from 1; tissue is scar, muscle or remote
///   x_mm,y_mm,z_mm                   the middle of the first pixel, image space
///   threshold,phase                  of the map
///   how,by,when                      of the slice, as of contours
[[nodiscard]] Table table_of(const ScarMap& map, const image::Cine& image);

/// Reads such a table, its columns in any order. Throws InputError, naming the line, for what is no
/// such row, a pixel that the image does not have or that stands there twice, and for pixels that
/// lie more than a tenth of their size from where the image has them.
[[nodiscard]] ScarMap read_scar_map(const std::filesystem::path& file, const image::Cine& image);

/// A stack on the planes of the image that is 1 in scar and 0 elsewhere. A pixel outside the wall
/// takes what the nearest pixel of the wall within 5 mm has, so that the edge of the wall that was
/// mapped is none of the scar.
[[nodiscard]] image::Cine scar_stack(const ScarMap& map, const image::Cine& image);

}  // namespace lv::scar
