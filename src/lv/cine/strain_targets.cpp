#include "lv/cine/strain_targets.hpp"

#include "lv/analysis/regional.hpp"
#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/base/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

namespace lv::cine {
namespace {

using case_file::Case;

constexpr const char* columns_rule =
    "The first line must be slice,segment,strain; then one line per segment, for instance "
    "3,ant,-0.19 or aha,7,-0.18";

/// One file, line by line.
class StrainFile {
 public:
  StrainFile(const Case& c, const mesh::Regions& regions)
      : regions_(regions),
        measure_(measure_of(c.calibration.strain_measure)),
        file_(case_file::beside(c, c.calibration.strains).string()),
        lines_(file_) {
    if (!lines_.is_open())
      throw InputError(case_file::place_of(c, "calibrate.strains"),
                       fmt::format("{} cannot be opened: {}", file_, unreadable(file_)),
                       "Check the name; it is relative to the case file");
  }

  std::vector<StrainTarget> read() {
    if (!next_line() || lower_case(join()) != "slice,segment,strain")
      throw InputError(lines_.where(), "these are not the columns of regional strains",
                       columns_rule);
    std::vector<StrainTarget> targets;
    while (next_line()) {
      StrainTarget target = row();
      for (const StrainTarget& other : targets)
        if (other.measured.region == target.measured.region)
          throw InputError(lines_.where(),
                           fmt::format("segment {} is there twice", target.measured.region),
                           "Give one strain per segment");
      targets.push_back(std::move(target));
    }
    if (targets.empty())
      throw InputError(lines_.where(), "the file holds no strains", columns_rule);
    return targets;
  }

 private:
  [[nodiscard]] std::string join() const { return fmt::format("{}", fmt::join(fields_, ",")); }

  bool next_line() {
    if (!lines_.next())
      return false;
    fields_ = csv_fields(lines_.text());
    return true;
  }

  StrainTarget row() {
    if (fields_.size() != 3)
      throw InputError(lines_.where(), fmt::format("has {} values instead of 3", fields_.size()),
                       columns_rule);
    StrainTarget target = lower_case(fields_[0]) == "aha" ? aha_segment() : sector();
    target.measured.value = strain::strain_in(fields_[2], measure_, lines_.where());
    if (target.cells.empty())
      throw InputError(lines_.where(),
                       fmt::format("the mesh has no element in segment {}", target.measured.region),
                       "Leave the segment out, or take a finer mesh");
    return target;
  }

  StrainTarget aha_segment() {
    const auto number = number_of<int>(fields_[1]);
    if (!number || *number < 1 || *number > 17)
      throw InputError(lines_.where(), fmt::format("segment \"{}\" is not of 1 to 17", fields_[1]),
                       "The segments of the American Heart Association are numbered 1 to 17");
    StrainTarget target{{fmt::format("{} {}", *number, mesh::aha_name(*number)), 0.0}, {}};
    for (std::size_t c = 0; c < regions_.aha.size(); ++c)
      if (regions_.aha[c] == *number)
        target.cells.push_back(static_cast<int>(c));
    return target;
  }

  StrainTarget sector() {
    const auto slice = number_of<int>(fields_[0]);
    if (!slice || *slice < 1 || *slice > mesh::slice_count)
      throw InputError(lines_.where(),
                       fmt::format("slice \"{}\" is neither 1 to 7 nor aha", fields_[0]),
                       "Slices are counted from the base");
    std::vector<std::string> names;
    for (int k = 1; k <= mesh::sectors_of_slice(*slice); ++k)
      names.push_back(mesh::sector_name(*slice, k));
    const auto found = std::find(names.begin(), names.end(), lower_case(fields_[1]));
    if (found == names.end())
      throw InputError(lines_.where(),
                       fmt::format("slice {} has no segment \"{}\"", *slice, fields_[1]),
                       fmt::format("Its segments are {}", fmt::join(names, ", ")));
    const int sector = static_cast<int>(found - names.begin()) + 1;
    StrainTarget target{{fmt::format("{} {}", *slice, *found), 0.0}, {}};
    for (std::size_t c = 0; c < regions_.slice.size(); ++c)
      if (regions_.slice[c] == *slice && regions_.sector[c] == sector)
        target.cells.push_back(static_cast<int>(c));
    return target;
  }

  const mesh::Regions& regions_;
  strain::Measure measure_;
  std::string file_;
  LineReader lines_;
  std::vector<std::string> fields_;
};

}  // namespace

strain::Measure measure_of(case_file::StrainMeasure measure) {
  return measure == case_file::StrainMeasure::green_lagrange ? strain::Measure::green_lagrange
                                                             : strain::Measure::engineering;
}

std::vector<StrainTarget> strain_targets(const Case& c, const mesh::Regions& regions) {
  if (c.calibration.strains.empty())
    return {};
  return StrainFile(c, regions).read();
}

std::vector<double> regional_strains(const Case& c, const mesh::Mesh& wall,
                                     const std::vector<StrainTarget>& targets,
                                     const std::vector<Vec3>& end_diastole,
                                     const std::vector<Vec3>& end_systole) {
  const solid::Wall elements(wall, case_file::myocardium(c));
  const auto then = analysis::shape_fields(elements, wall, end_diastole);
  const auto now = analysis::shape_fields(elements, wall, end_systole);
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
