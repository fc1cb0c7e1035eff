#include "lv/cine/strain_targets.hpp"

#include "lv/analysis/regional.hpp"
#include "lv/base/parallel.hpp"
#include "lv/mesh/quadratic.hpp"

#include <cmath>

namespace lv::cine {

using case_file::Case;

strain::Measure measure_of(case_file::StrainMeasure measure) {
  return measure == case_file::StrainMeasure::green_lagrange ? strain::Measure::green_lagrange
                                                             : strain::Measure::engineering;
}

std::vector<strain::RegionStrain> strain_targets(const Case& c, const mesh::Regions& regions) {
  if (c.calibration.strains.empty())
    return {};
  return strain::read_region_strains(case_file::beside(c, c.calibration.strains).string(),
                                     measure_of(c.calibration.strain_measure), regions,
                                     case_file::place_of(c, "calibrate.strains"));
}

std::vector<double> regional_strains(const Case& c, const mesh::Mesh& wall,
                                     const std::vector<strain::RegionStrain>& targets,
                                     const std::vector<Vec3>& end_diastole,
                                     const std::vector<Vec3>& end_systole) {
  const solid::Wall elements(wall, case_file::myocardium(c));
  const std::vector<double> volumes = mesh::cell_volumes(wall);
  const auto then = analysis::shape_fields(elements, volumes, end_diastole);
  const auto now = analysis::shape_fields(elements, volumes, end_systole);
  std::vector<double> E_cc;
  for (std::size_t i = 0; i < now.size(); ++i)
    E_cc.push_back(analysis::strain(now[i], then[i]).circumferential);
  std::vector<double> means(targets.size(), 0.0);
  for (std::size_t t = 0; parallel::is_root() && t < targets.size(); ++t) {
    means[t] = analysis::statistics(E_cc, now, targets[t].cells).mean;
    if (c.calibration.strain_measure == case_file::StrainMeasure::engineering)
      means[t] = std::sqrt(1.0 + 2.0 * means[t]) - 1.0;
  }
  parallel::broadcast(means);
  return means;
}

}  // namespace lv::cine
