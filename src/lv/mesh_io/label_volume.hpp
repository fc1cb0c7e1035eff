#pragma once

#include "lv/base/bounds.hpp"

#include <memory>
#include <string>
#include <vector>

namespace lv::mesh_io {

/// An image whose voxels carry whole numbers that mean something: a VTK image with an array of
/// labels at its points, which are then the centres of voxels, or in its cells.
class LabelVolume {
 public:
  /// Reads a .vti or a legacy .vtk file (structured points) of one time. An empty `array` means the
  /// file's only one; `unit` is the length of the file's unit [mm]. Throws InputError where the
  /// file cannot be read, the array is missing, or a voxel has no whole number or several.
  LabelVolume(const std::string& file, const std::string& array, double unit);
  ~LabelVolume();
  LabelVolume(LabelVolume&&) noexcept;
  LabelVolume& operator=(LabelVolume&&) noexcept;

  /// All labels that occur, ascending.
  [[nodiscard]] const std::vector<int>& labels() const { return labels_; }

  /// Whether x [mm] lies in a voxel with one of these labels; false outside the image.
  [[nodiscard]] bool has(const Vec3& x, const std::vector<int>& labels) const;

  /// The box around the image [mm].
  [[nodiscard]] Eigen::AlignedBox3d box() const;

 private:
  struct Image;
  std::unique_ptr<Image> image_;
  std::vector<int> labels_;
};

}  // namespace lv::mesh_io
