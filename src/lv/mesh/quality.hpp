#pragma once

#include "lv/mesh/mesh.hpp"

#include <string>
#include <vector>

namespace lv::mesh {

struct Spread {
  double min = 0.0, mean = 0.0, max = 0.0;
};

/// Counts of values in equal bins between `lower` and `upper`; values outside go to the nearest
/// bin.
struct Histogram {
  double lower = 0.0, upper = 1.0;
  std::vector<int> counts;
};

/// How good and how large the mesh of a wall is.
struct Quality {
  int cells = 0, nodes = 0;
  Spread scaled_jacobian;    ///< see cell.hpp: 1 is best, 0 flat, below 0 inverted
  Spread aspect_ratio;       ///< see cell.hpp: 1 is best
  Spread edge_length;        ///< [mm]
  double wall_volume = 0.0;  ///< [mm^3]
  double endo_area = 0.0, epi_area = 0.0, base_area = 0.0;  ///< [mm^2]
  int worst_cell = 0;                                       ///< of the smallest scaled Jacobian
  Vec3 worst_place = Vec3::Zero();                          ///< its centre [mm]
  Histogram scaled_jacobians;                               ///< ten bins from 0 to 1
};

[[nodiscard]] Quality quality(const Mesh& mesh);

/// One line of a table of figures.
struct QualityRow {
  std::string quantity;
  double value;
  std::string unit;
};

/// The figures in mm, ml and cm^2, ready for a table; the histogram's bins at the end.
[[nodiscard]] std::vector<QualityRow> table(const Quality& quality);

}  // namespace lv::mesh
