#pragma once

#include "lv/base/table.hpp"
#include "lv/case_file/case.hpp"
#include "lv/mesh/regions.hpp"

#include <string>
#include <vector>

namespace lv::scar {

/// What the strain of a part of the wall says of an infarct: weaker than the threshold by the
/// error of strain or more, stronger by as much, or neither. What is undecided goes by the
/// threshold alone.
struct StrainVerdict {
  std::string region;
  double shortening = 0.0;  ///< end-systolic circumferential strain as a change of length, l/L - 1
  bool is_infarct = false, is_undecided = false;
  std::vector<int> cells;
};

/// Of infarct.strain.file. Throws InputError naming file and line.
[[nodiscard]] std::vector<StrainVerdict> strain_verdicts(const case_file::Case& c,
                                                         const mesh::Regions& regions);

/// "from strain, not from late enhancement: ..." with the names of infarcted and undecided parts.
[[nodiscard]] std::string describe(const case_file::Case& c,
                                   const std::vector<StrainVerdict>& verdicts);

/// infarct_strain.csv: region, shortening, threshold, verdict.
[[nodiscard]] Table strain_infarct_table(const case_file::Case& c,
                                         const std::vector<StrainVerdict>& verdicts);

}  // namespace lv::scar
