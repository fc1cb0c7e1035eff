#include "lv/scar/strain_infarct.hpp"

#include "lv/strain/region_strains.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace lv::scar {
namespace {

using case_file::Case;

std::string names(const std::vector<StrainVerdict>& verdicts, bool StrainVerdict::*which) {
  std::vector<std::string> found;
  for (const StrainVerdict& v : verdicts)
    if (v.*which)
      found.push_back(v.region);
  return found.empty() ? "none" : fmt::format("{}", fmt::join(found, ", "));
}

}  // namespace

std::vector<StrainVerdict> strain_verdicts(const Case& c, const mesh::Regions& regions) {
  const case_file::StrainInfarct& scar = c.scar_strain;
  const bool is_green = scar.measure == case_file::StrainMeasure::green_lagrange;
  std::vector<StrainVerdict> verdicts;
  for (strain::RegionStrain& s : strain::read_region_strains(
           case_file::beside(c, scar.file).string(),
           is_green ? strain::Measure::green_lagrange : strain::Measure::engineering, regions,
           case_file::place_of(c, "infarct.strain.file"))) {
    const double shortening = is_green ? std::sqrt(1.0 + 2.0 * s.strain) - 1.0 : s.strain;
    const double beyond = shortening - scar.threshold;
    verdicts.push_back({std::move(s.region), shortening, beyond > 0.0,
                        std::abs(beyond) < scar.error, std::move(s.cells)});
  }
  return verdicts;
}

std::string describe(const Case& c, const std::vector<StrainVerdict>& verdicts) {
  return fmt::format(
      "from strain, not from late enhancement: end-systolic circumferential strain above {:g}% is "
      "taken for an infarct ({}); within {:g}% of it, and so undecided: {}",
      100.0 * c.scar_strain.threshold, names(verdicts, &StrainVerdict::is_infarct),
      100.0 * c.scar_strain.error, names(verdicts, &StrainVerdict::is_undecided));
}

Table strain_infarct_table(const Case& c, const std::vector<StrainVerdict>& verdicts) {
  Table table({"region", "shortening", "threshold", "infarct", "undecided"});
  for (const StrainVerdict& v : verdicts)
    table.add_row({v.region, Table::number(v.shortening), Table::number(c.scar_strain.threshold),
                   v.is_infarct ? "yes" : "no", v.is_undecided ? "yes" : "no"});
  return table;
}

}  // namespace lv::scar
