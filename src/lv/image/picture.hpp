#pragma once

#include "lv/base/tensor.hpp"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace lv::image {

/// What pixels of a person's images can measure [mm]: others stand for a wrong unit.
inline constexpr double smallest_pixel = 1e-2;
inline constexpr double largest_pixel = 1e2;

/// Where one image lies in image space (LPS as in DICOM: x to the patient's left, y to the back, z
/// to the head) [mm]. Pixel (i, j), column i of row j, has its centre at
///
///   x(i, j) = origin + i spacing_i along_row + j spacing_j along_column     (DICOM PS3.3 C.7.6.2.1.1)
struct Plane {
  Vec3 origin = Vec3::Zero();         ///< centre of pixel (0, 0)
  Vec3 along_row = Vec3::UnitX();     ///< unit vector of growing column index i
  Vec3 along_column = Vec3::UnitY();  ///< unit vector of growing row index j
  double spacing_i = 1.0;             ///< between columns
  double spacing_j = 1.0;             ///< between rows
  int columns = 0, rows = 0;

  [[nodiscard]] Vec3 normal() const { return along_row.cross(along_column); }
  [[nodiscard]] Vec3 point(double i, double j) const {
    return origin + i * spacing_i * along_row + j * spacing_j * along_column;
  }
  /// Where the value of a pixel stands, row by row.
  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * columns + i;
  }
  /// Of the image.
  [[nodiscard]] Vec3 middle() const { return point(0.5 * (columns - 1), 0.5 * (rows - 1)); }
  /// (i, j, distance along the normal) of a point; i and j in pixels, the distance in mm.
  [[nodiscard]] Vec3 pixel(const Vec3& x) const {
    const Vec3 d = x - origin;
    return {d.dot(along_row) / spacing_i, d.dot(along_column) / spacing_j, d.dot(normal())};
  }
};

/// One image: values row by row.
struct Picture {
  Plane plane;
  std::vector<float> values;  ///< rows x columns

  [[nodiscard]] float at(int i, int j) const { return values[plane.index(i, j)]; }
};

/// Images of one plane over the heart's cycle, in order of time.
struct CineSlice {
  std::string name;             ///< for messages and tables
  std::vector<Picture> frames;  ///< all on one plane
  std::vector<double> times;    ///< after the R wave, one per frame [s]; empty if not known
  double rr = 0.0;              ///< length of the heart's cycle [s]; 0 if not known
};

/// All slices of one orientation, in order along their common normal.
struct Cine {
  std::vector<CineSlice> slices;
  std::vector<std::string> notes;  ///< what a reader found worth saying, in sentences
};

}  // namespace lv::image
