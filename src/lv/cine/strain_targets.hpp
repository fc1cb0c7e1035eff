#pragma once

#include "lv/calibrate/fit.hpp"
#include "lv/case_file/case.hpp"
#include "lv/mesh/mesh.hpp"
#include "lv/strain/agreement.hpp"

namespace lv::cine {

/// A part of the wall whose mean circumferential strain was measured.
struct StrainTarget {
  calibrate::MeasuredStrain measured;
  std::vector<int> cells;
};

/// A case's word for a measure of strain.
[[nodiscard]] strain::Measure measure_of(case_file::StrainMeasure measure);

/// The targets of calibrate.strains, a CSV file with the columns slice, segment and strain:
///
///   3,ant,-0.19     slice 1 (base) to 7 of the paper's division, segment ant, antsept, infsept, inf,
///                   inflat or antlat (slices 6 and 7: ant, sept, inf, lat)
///   aha,7,-0.18     segment 1 to 17 of the American Heart Association
///
/// Strain is circumferential, at end-systole from end-diastole. None for a case without the file.
/// Throws InputError naming file and line.
[[nodiscard]] std::vector<StrainTarget> strain_targets(const case_file::Case& c,
                                                       const mesh::Regions& regions);

/// The model's strains of the targets between two shapes of a wall, the volume-weighted mean of
/// E_cc over each part, as the tables give it, in the case's measure. Collective; the same on all
/// ranks.
[[nodiscard]] std::vector<double> regional_strains(const case_file::Case& c, const mesh::Mesh& wall,
                                                   const std::vector<StrainTarget>& targets,
                                                   const std::vector<Vec3>& end_diastole,
                                                   const std::vector<Vec3>& end_systole);

}  // namespace lv::cine
