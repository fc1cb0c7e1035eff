#pragma once

#include "lv/mesh/regions.hpp"
#include "lv/strain/agreement.hpp"

namespace lv::strain {

/// The mean circumferential strain of a part of the wall.
struct RegionStrain {
  std::string region;  ///< "3 ant" or "7 mid anterior"
  double strain = 0.0;
  std::vector<int> cells;  ///< of the mesh in it
};

/// Reads a CSV file with the columns slice, segment and strain:
///
///   3,ant,-0.19     slice 1 (base) to 7 of the paper's division, segment ant, antsept, infsept, inf,
///                   inflat or antlat (slices 6 and 7: ant, sept, inf, lat)
///   aha,7,-0.18     segment 1 to 17 of the American Heart Association
///
/// Throws InputError naming file and line, or `named_at` for a file that cannot be opened.
[[nodiscard]] std::vector<RegionStrain> read_region_strains(const std::string& file,
                                                            Measure measure,
                                                            const mesh::Regions& regions,
                                                            const std::string& named_at);

}  // namespace lv::strain
