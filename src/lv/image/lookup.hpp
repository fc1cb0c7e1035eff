#pragma once

#include "lv/image/volume.hpp"

#include <span>
#include <vector>

namespace lv::image {

/// Whether a number, such as a voxel's value, is one of these labels.
[[nodiscard]] bool is_one_of(double value, const std::vector<int>& labels);

/// Whether x lies in a voxel of the image.
[[nodiscard]] bool shows(const Volume& volume, const Vec3& x);

/// Whether x lies in a voxel with one of these labels; false outside the image. `moves`, if there
/// are any, say by how much each slice across slice_axis has been moved in image space.
[[nodiscard]] bool has_label(const Volume& volume, const Vec3& x, const std::vector<int>& labels,
                             std::span<const Vec3> moves = {});

/// Of the slices across slice_axis those, true, in which no voxel has one of these labels while one
/// on either side of them has: they were not drawn.
[[nodiscard]] std::vector<bool> undrawn_slices(const Volume& volume,
                                               const std::vector<int>& labels);

/// x, or where it lies in one of these slices, x moved across the slices into the nearest one that
/// is none of them.
[[nodiscard]] Vec3 in_drawn_slice(const Volume& volume, const std::vector<bool>& undrawn,
                                  const Vec3& x);

/// The value of a picture at the foot of a point above or below it: linear between its pixels; NaN
/// beyond them.
[[nodiscard]] double sample(const Picture& picture, const Vec3& x);

/// The value of a stack of images (first frames) at x, linear between the pixels of a slice and
/// between the two slices that x lies between: an edge across a slab makes it half as bright, and
/// is so found within the slab. Beyond the first and the last slice theirs, up to half the way to
/// where the next would be (for a single slice, 5 mm); NaN farther and beyond the pixels.
[[nodiscard]] double sample(const Cine& stack, const Vec3& x);

}  // namespace lv::image
