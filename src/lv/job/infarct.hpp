#pragma once

#include "lv/base/table.hpp"
#include "lv/job/anatomy.hpp"
#include "lv/job/case.hpp"

#include <string>
#include <vector>

namespace lv::job {

/// M(X) per node of the wall's mesh as the case asks for it. Throws InputError where a file cannot
/// be used or the infarct holds no element of the wall.
[[nodiscard]] std::vector<double> infarct_extent(const Case& c, const Shape& shape,
                                                 const mesh::Mesh& mesh);

/// The files that the infarct is read from, by parameter, with what stands for their contents.
[[nodiscard]] Ingredients infarct_files(const Case& c);

/// infarct.csv: per AHA segment the infarct's volume, mass (with the density of the case), part of
/// the segment and transmurality (see mesh::infarct_by_segment).
[[nodiscard]] Table infarct_table(const Case& c, const mesh::Mesh& mesh,
                                  const mesh::Regions& regions);

/// "infarct: 68.54 ml (60.0% of the wall), 68.5 g; border zone: ..."; empty without an infarct.
[[nodiscard]] std::string describe_infarct(const Case& c, const mesh::Mesh& mesh);

}  // namespace lv::job
