#pragma once

#include "lv/base/tensor.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lv::geometry {

/// The two surfaces of the wall.
enum class Side { endo, epi };

/// "endo" or "epi", as files and messages call it.
[[nodiscard]] const char* name(Side side);

/// Who drew a line, and how. Empty where it is not known.
struct Provenance {
  std::string how;   ///< "proposed" by the program, "corrected" from such a proposal, or "drawn"
  std::string by;    ///< as the observer calls herself
  std::string when;  ///< 2026-01-31T12:00:00Z
};

/// A line drawn on one image: a closed loop on a short-axis slice (the last point joins the first),
/// an open curve on a long-axis image, or a single point at the apex.
struct Contour {
  int slice = 0;
  Side side = Side::endo;
  std::vector<Vec3> points;  ///< in order along the line, image space (scanner, LPS) [mm]
  std::string file;          ///< where the line comes from, for messages
  std::vector<int> lines;    ///< the file's line of each point; empty if it has none
  Provenance drawn = {};

  /// "file:line" of a point.
  [[nodiscard]] std::string where(std::size_t point = 0) const;
};

/// What an observer drew of one ventricle at one time, in ascending order of slices.
struct Contours {
  std::vector<Contour> short_axis;
  std::vector<Contour> long_axis;
  std::vector<Contour> apex;  ///< one point each
  std::vector<Vec3> annulus;  ///< points of the mitral annulus, image space [mm]
};

/// Drops points that repeat the one before; a loop is closed by its last segment, not by repeating
/// its first point.
void drop_repeats(Contour& loop);

/// The contour of a slice and side, or null.
[[nodiscard]] const Contour* find(const std::vector<Contour>& contours, int slice, Side side);

struct ContourFiles {
  std::filesystem::path short_axis;
  std::optional<std::filesystem::path> long_axis;
  std::vector<std::filesystem::path> apex;  ///< single points at the tip of either surface
};

/// Reads contours from CSV files and checks them (see check_contours). The first line names the
/// columns, in any order: slice, contour (endo or epi), point (the number along the line), x_mm,
/// y_mm, z_mm. px_x and px_y may be there and are not used; so may how (proposed, corrected or
/// drawn), by and when, the same on all points of a line. Points of a loop that repeat the one
/// before, or at its end the first, are dropped. @throws InputError naming file and line,
/// what is wrong and what to do.
[[nodiscard]] Contours read_contours(const ContourFiles& files);

/// Reads curves on long-axis images from a CSV file of the same columns, unchecked.
[[nodiscard]] std::vector<Contour> read_curves(const std::filesystem::path& file);

}  // namespace lv::geometry
