#pragma once

#include "lv/image/picture.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace lv::image {

/// Voxels in space, at one or more times. Voxel (i, j, k) has its centre at
///
///   x = origin + directions (spacing_1 i, spacing_2 j, spacing_3 k)     image space (LPS) [mm]
struct Volume {
  std::string file;  ///< for messages
  std::array<int, 3> size{0, 0, 0};
  int frames = 1;
  Vec3 origin = Vec3::Zero();
  Mat3 directions = Mat3::Identity();  ///< columns: unit vectors of growing i, j, k
  Vec3 spacing = Vec3::Ones();         ///< [mm]
  double time_step = 0.0;              ///< between frames; 0 if not known [s]
  std::vector<float> values;           ///< i fastest, then j, k and the frame
  std::map<int, std::string> names;    ///< of labels, where the file states them
  std::vector<std::string> notes;      ///< what the reader found worth saying

  [[nodiscard]] std::size_t voxels() const {
    return static_cast<std::size_t>(size[0]) * size[1] * size[2];
  }
  [[nodiscard]] float at(int i, int j, int k, int frame = 0) const {
    return values[voxels() * frame + (static_cast<std::size_t>(k) * size[1] + j) * size[0] + i];
  }
  [[nodiscard]] Vec3 point(const Vec3& ijk) const {
    return origin + directions * spacing.cwiseProduct(ijk);
  }
  /// Inverse of point, in voxels.
  [[nodiscard]] Vec3 index(const Vec3& x) const {
    return (directions.transpose() * (x - origin)).cwiseQuotient(spacing);
  }
  [[nodiscard]] double voxel_volume() const { return spacing.prod(); }  ///< [mm^3]
};

/// The axis (0, 1 or 2) that the slices are stacked along: the one with the largest spacing; the
/// third where no spacing is 1.2 times the others, as in images of cubic voxels.
[[nodiscard]] int slice_axis(const Volume& volume);

/// The slices of one frame across an axis, in order of growing index; in the plane the remaining
/// axes in their order.
[[nodiscard]] std::vector<Picture> slices(const Volume& volume, int axis, int frame = 0);

/// The slices across slice_axis as a cine: all frames of each, with times if the file has a time
/// step.
[[nodiscard]] Cine cine_of(const Volume& volume);

/// The mean distance of neighbouring slices along their normal; 0 of a single one [mm].
[[nodiscard]] double spacing_of(const Cine& cine);

/// The slice whose plane is the nearest to a point of image space [mm].
[[nodiscard]] std::size_t nearest_slice(const Cine& cine, const Vec3& x);

/// One frame, counted from 1, as a volume of its own. Throws InputError, which names `where` the
/// frame was chosen, if there is no such frame.
[[nodiscard]] Volume frame_of(const Volume& volume, int frame, const std::string& where);

/// The frames, counted from 1, in which any of these labels occurs.
[[nodiscard]] std::vector<int> frames_with(const Volume& volume, const std::vector<int>& labels);

/// Volume of each label of one frame [mm^3]. Throws InputError naming the voxel if a value is no
/// whole number.
[[nodiscard]] std::map<int, double> label_volumes(const Volume& volume, int frame = 0);

/// "0 (8123.40 ml), 1 \"LV blood\" (191.20 ml)", with the names that a file states.
[[nodiscard]] std::string describe(const std::map<int, double>& label_volumes,
                                   const std::map<int, std::string>& names = {});

/// Throws InputError, listing the labels that there are with their volumes, unless the frame exists
/// and every label occurs in it and is not 0, the background. `parameter` names the choice in
/// messages; `where` is its place.
void require_labels(const Volume& volume, int frame, const std::vector<int>& labels,
                    const std::string& where, const std::string& parameter,
                    const std::string& remedy = "Name the labels as this file has them");

}  // namespace lv::image
