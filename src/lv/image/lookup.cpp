#include "lv/image/lookup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace lv::image {
namespace {

/// A slice and its signed distance from a point, along the normal of the first slice [mm].
struct Level {
  const Picture* picture;
  double height;
};

std::vector<Level> levels_by_distance(const Cine& stack, const Vec3& x) {
  std::vector<Level> levels;
  for (const CineSlice& slice : stack.slices) {
    const Picture& picture = slice.frames.front();
    const Vec3 normal = stack.slices.front().frames.front().plane.normal();
    levels.push_back({&picture, normal.dot(picture.plane.origin - x)});
  }
  std::sort(levels.begin(), levels.end(),
            [](const Level& a, const Level& b) { return std::abs(a.height) < std::abs(b.height); });
  return levels;
}

/// The voxel that holds a place given in voxels; nothing outside the image.
std::optional<std::array<int, 3>> voxel_at(const Volume& volume, const Vec3& ijk) {
  std::array<int, 3> at{};
  for (int d = 0; d < 3; ++d) {
    const double nearest = std::round(ijk[d]);
    if (!(nearest >= 0 && nearest < volume.size[d]))
      return std::nullopt;
    at[d] = static_cast<int>(nearest);
  }
  return at;
}

}  // namespace

bool shows(const Volume& volume, const Vec3& x) {
  return voxel_at(volume, volume.index(x)).has_value();
}

bool is_one_of(double value, const std::vector<int>& labels) {
  return std::find(labels.begin(), labels.end(), value) != labels.end();
}

bool has_label(const Volume& volume, const Vec3& x, const std::vector<int>& labels,
               std::span<const Vec3> moves) {
  const int axis = slice_axis(volume);
  Vec3 ijk = volume.index(x);
  if (!moves.empty()) {
    const double slice = std::round(ijk[axis]);
    if (!(slice >= 0 && slice < volume.size[axis]))
      return false;
    ijk = volume.index(x - moves[static_cast<std::size_t>(slice)]);
  }
  const auto at = voxel_at(volume, ijk);
  return at && is_one_of(volume.at((*at)[0], (*at)[1], (*at)[2]), labels);
}

std::vector<bool> undrawn_slices(const Volume& volume, const std::vector<int>& labels) {
  std::vector<bool> undrawn;
  for (const Picture& slice : slices(volume, slice_axis(volume)))
    undrawn.push_back(std::none_of(slice.values.begin(), slice.values.end(),
                                   [&](auto value) { return is_one_of(value, labels); }));
  const auto first = std::find(undrawn.begin(), undrawn.end(), false);
  std::fill(undrawn.begin(), first, false);
  const auto last = std::find(undrawn.rbegin(), undrawn.rend(), false);
  std::fill(undrawn.rbegin(), last, false);
  return undrawn;
}

Vec3 in_drawn_slice(const Volume& volume, const std::vector<bool>& undrawn, const Vec3& x) {
  const int axis = slice_axis(volume);
  const double at = volume.index(x)[axis];
  const auto count = static_cast<int>(undrawn.size());
  const double here = std::round(at);
  if (!(here >= 0.0 && here < count) || !undrawn[static_cast<std::size_t>(here)])
    return x;
  double nearest = std::numeric_limits<double>::infinity();
  for (int slice = 0; slice < count; ++slice)
    if (!undrawn[static_cast<std::size_t>(slice)] && std::abs(slice - at) < std::abs(nearest - at))
      nearest = slice;
  return x + (nearest - at) * volume.spacing[axis] * volume.directions.col(axis);
}

double sample(const Picture& picture, const Vec3& x) {
  const Vec3 pixel = picture.plane.pixel(x);
  const double i = pixel.x();
  const double j = pixel.y();
  const int columns = picture.plane.columns;
  const int rows = picture.plane.rows;
  if (!(i >= -0.5 && j >= -0.5 && i <= columns - 0.5 && j <= rows - 0.5))
    return std::numeric_limits<double>::quiet_NaN();
  const double a = std::clamp(i, 0.0, columns - 1.0);
  const double b = std::clamp(j, 0.0, rows - 1.0);
  const int i0 = std::min(static_cast<int>(a), columns - 2);
  const int j0 = std::min(static_cast<int>(b), rows - 2);
  const double u = a - i0;
  const double v = b - j0;
  return (1 - u) * (1 - v) * picture.at(i0, j0) + u * (1 - v) * picture.at(i0 + 1, j0) +
         (1 - u) * v * picture.at(i0, j0 + 1) + u * v * picture.at(i0 + 1, j0 + 1);
}

double sample(const Cine& stack, const Vec3& x) {
  constexpr double alone = 5.0;  // half a slab [mm]
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Level> levels = levels_by_distance(stack, x);
  if (levels.empty())
    return nan;
  const Level& nearest = levels.front();
  const double value = sample(*nearest.picture, x);
  const auto other = std::find_if(levels.begin(), levels.end(), [&](const Level& level) {
    return level.height * nearest.height < 0.0;
  });
  if (other != levels.end()) {
    const double further = sample(*other->picture, x);
    const double u = nearest.height / (nearest.height - other->height);
    return std::isnan(further) ? value : (1.0 - u) * value + u * further;
  }
  const double half = levels.size() > 1 ? 0.5 * std::abs(levels[1].height - nearest.height) : alone;
  return std::abs(nearest.height) > half + 1e-6 ? nan : value;
}

}  // namespace lv::image
