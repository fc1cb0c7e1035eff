#include "lv/image/pixel_grid.hpp"

#include "lv/base/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lv::image {
namespace {

bool equally_long(double a, double b) {
  constexpr double rounding = 1e-3;  // of headers that write few digits
  return std::abs(a - b) <= rounding * std::max(a, b);
}

}  // namespace

std::string spacing_text(const Plane& plane) {
  return std::abs(plane.spacing_i - plane.spacing_j) < 1e-4 * plane.spacing_i
             ? fmt::format("{:.3f} mm", plane.spacing_i)
             : fmt::format("{:.3f} x {:.3f} mm", plane.spacing_i, plane.spacing_j);
}

std::string grid_text(const Plane& plane) {
  return fmt::format("{} x {} pixels of {}", plane.columns, plane.rows, spacing_text(plane));
}

bool same_grid(const Plane& a, const Plane& b) {
  return a.columns == b.columns && a.rows == b.rows && equally_long(a.spacing_i, b.spacing_i) &&
         equally_long(a.spacing_j, b.spacing_j);
}

std::string unusual_pixels(double spacing_i, double spacing_j) {
  constexpr double least = 0.3;  // [mm]
  constexpr double most = 5.0;
  const auto [smaller, larger] = std::minmax(spacing_i, spacing_j);
  if (smaller >= least && larger <= most)
    return "";
  return fmt::format("pixels of {:.2g} mm: the header's unit seems wrong",
                     smaller < least ? smaller : larger);
}

void require_one_grid(const Cine& cine, const std::string& where, const std::string& parameter) {
  for (const CineSlice& slice : cine.slices) {
    const Plane& first = cine.slices.front().frames.front().plane;
    const Plane& plane = slice.frames.front().plane;
    if (!same_grid(first, plane))
      throw InputError(
          where,
          fmt::format("{} has {} and {} has {}; slices of one grid are needed",
                      cine.slices.front().name, grid_text(first), slice.name, grid_text(plane)),
          fmt::format("Choose with {} a series whose slices are alike, leave the files of the "
                      "other slice out, or export the images again with one PixelSpacing and size",
                      parameter));
  }
}

}  // namespace lv::image
