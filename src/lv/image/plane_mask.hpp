#pragma once

#include "lv/image/picture.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace lv::image {

/// Which pixels of a slice belong to something.
struct PlaneMask {
  int columns = 0, rows = 0;
  std::vector<unsigned char> inside;  ///< 1 or 0, row by row

  PlaneMask(int columns_, int rows_)
      : columns(columns_), rows(rows_), inside(static_cast<std::size_t>(columns_) * rows_, 0) {}
  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] bool at(int i, int j) const {
    return inside[static_cast<std::size_t>(j) * columns + i] != 0;
  }
};

/// The pixels of a slice that have one of these labels.
[[nodiscard]] PlaneMask mask_of(const Picture& picture, const std::vector<int>& labels);

/// The part of a mask's edge, in edges of pixels, that lies on another; 0 without an edge.
[[nodiscard]] double part_of_edge_on(const PlaneMask& other, const PlaneMask& mask);

/// The parts of a mask whose pixels hang together along edges, largest first.
[[nodiscard]] std::vector<PlaneMask> parts(const PlaneMask& mask);

/// The mask with everything that it encloses.
[[nodiscard]] PlaneMask filled(const PlaneMask& mask);

/// A closed line in pixels: x along the row (column index), y down the rows; pixel centres are
/// whole numbers.
using PixelLoop = std::vector<Eigen::Vector2d>;

/// The longest line that runs half way between the centres of pixels inside and outside (marching
/// squares at 0.5), without repeating its first point; empty for an empty mask. It encloses the
/// area of the pixels less about half a pixel for its four blunt corners.
[[nodiscard]] PixelLoop outline(const PlaneMask& mask);

/// Area of a closed line [pixels].
[[nodiscard]] double area(const PixelLoop& loop);

}  // namespace lv::image
