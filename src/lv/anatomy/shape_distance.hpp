#pragma once

#include "lv/base/table.hpp"
#include "lv/geometry/contours.hpp"
#include "lv/geometry/frame.hpp"
#include "lv/mesh/mesh.hpp"

#include <span>
#include <string>
#include <vector>

namespace lv::anatomy {

/// Distances of drawn points from a surface of the model [mm].
struct DrawnDistance {
  int slice = 0;  ///< 0: all slices
  geometry::Side side = geometry::Side::endo;
  int points = 0;
  double mean = 0.0, rms = 0.0, p95 = 0.0, max = 0.0;
};

/// How far drawn loops are from the wall of the model at the same time. The model's base stays in
/// its plane, that of a heart comes down to the apex: the loops are compared as they lie, and once
/// more moved along the long axis to where they fit best. Points above the base plane do not count.
struct ShapeDistance {
  std::vector<DrawnDistance> as_drawn;  ///< endocardium and epicardium, all slices
  double axial_shift = 0.0;             ///< of the loops, towards the base [mm]
  std::vector<DrawnDistance> shifted;   ///< all slices, then each
};

/// `nodes` are those of the mesh at that time, `frame` the model's place in the images.
[[nodiscard]] ShapeDistance shape_distance(const mesh::Mesh& mesh, std::span<const Vec3> nodes,
                                           const geometry::Frame& frame,
                                           const std::vector<geometry::Contour>& loops);

/// A part of a drawn loop: the points of one sector of 60 degrees about the loop's centre.
struct DrawnPart {
  std::string name;  ///< slice, contour and sector
  geometry::Side side = geometry::Side::endo;
  std::vector<Vec3> points;  ///< in the model frame [mm]
};

/// Parts of loops, with the septum at `septum_angle` about the long axis of the model [rad].
[[nodiscard]] std::vector<DrawnPart> drawn_parts(const geometry::Frame& frame,
                                                 const std::vector<geometry::Contour>& loops,
                                                 double septum_angle);

/// By how much the model's surface lies outside of each part, in the mean of its points, when all
/// are moved along the long axis as `shape_distance` moves them [mm]. Points fade out over the last
/// millimetres below the base plane, above which they do not count.
[[nodiscard]] std::vector<double> mean_distances(const mesh::Mesh& mesh,
                                                 std::span<const Vec3> nodes,
                                                 const std::vector<DrawnPart>& parts);

[[nodiscard]] Table shape_distance_table(const ShapeDistance& distance);

/// A paragraph for a terminal.
[[nodiscard]] std::string shape_distance_text(const ShapeDistance& distance);

}  // namespace lv::anatomy
