#pragma once

#include "lv/calibrate/fit.hpp"
#include "lv/case_file/case.hpp"
#include "lv/mesh/mesh.hpp"
#include "lv/strain/region_strains.hpp"

namespace lv::cine {

/// A case's word for a measure of strain.
[[nodiscard]] strain::Measure measure_of(case_file::StrainMeasure measure);

/// The strains of calibrate.strains; none for a case without the file.
/// Throws InputError naming file and line.
[[nodiscard]] std::vector<strain::RegionStrain> strain_targets(const case_file::Case& c,
                                                               const mesh::Regions& regions);

/// The model's strains of the targets between two shapes of a wall, the volume-weighted mean of
/// E_cc over each part, as the tables give it, in the case's measure. Collective; the same on all
/// ranks.
[[nodiscard]] std::vector<double> regional_strains(const case_file::Case& c, const mesh::Mesh& wall,
                                                   const std::vector<strain::RegionStrain>& targets,
                                                   const std::vector<Vec3>& end_diastole,
                                                   const std::vector<Vec3>& end_systole);

}  // namespace lv::cine
