#pragma once

#include "lv/analysis/quantities.hpp"
#include "lv/mesh/regions.hpp"

#include <string>
#include <vector>

namespace lv::analysis {

/// A quantity with its value in every element.
struct CellQuantity {
  const Quantity* quantity;
  std::vector<double> values;
};

/// All quantities for one state, with strains from `then` (end-diastole for systole; the undeformed
/// wall when empty).
[[nodiscard]] std::vector<CellQuantity> cell_quantities(const std::vector<CellFields>& now,
                                                        const std::vector<CellFields>& then);

/// A part of the wall: its elements.
struct Region {
  std::string scheme;  ///< whole, third, slice, sector, aha17, zone
  std::string name;
  std::vector<int> cells;
};

/// The whole wall; its basal, middle and apical third (slices 1-2, 3-5, 6-7: the paper's Table 2);
/// the seven slices; their 38 sectors; the 17 AHA segments; and, when there is an infarct, infarct
/// (M = 1), border zone and remote muscle.
[[nodiscard]] std::vector<Region> region_list(const mesh::Regions& regions,
                                              const std::vector<CellFields>& cells);

/// Mean and standard deviation, weighted by undeformed volume, and percentiles of a quantity over a
/// region. NaN for a region without elements.
struct Statistics {
  double mean, sd;
  double p1, p50, p99;
};
[[nodiscard]] Statistics statistics(const std::vector<double>& values,
                                    const std::vector<CellFields>& cells,
                                    const std::vector<int>& members);

/// Mean rotation of a region about the long axis from one state to another, about the region's own
/// centre, as the rigid rotation that fits best [rad]. Positive anticlockwise seen from the apex,
/// the sense of a normal apex in systole.
[[nodiscard]] double rotation(const std::vector<CellFields>& now,
                              const std::vector<CellFields>& then, const std::vector<int>& members);

}  // namespace lv::analysis
