#include "lv/strain/region_strains.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lv::strain {
namespace {

constexpr const char* columns_rule =
    "The first line must be slice,segment,strain; then one line per segment, for instance "
    "3,ant,-0.19 or aha,7,-0.18";

/// One file, line by line.
class StrainFile {
 public:
  StrainFile(const std::string& file, Measure measure, const mesh::Regions& regions,
             const std::string& named_at)
      : regions_(regions), measure_(measure), lines_(file) {
    if (!lines_.is_open())
      throw InputError(named_at, fmt::format("{} cannot be opened: {}", file, unreadable(file)),
                       "Check the name; it is relative to the case file");
  }

  std::vector<RegionStrain> read() {
    if (!next_line() || lower_case(join()) != "slice,segment,strain")
      throw InputError(lines_.where(), "these are not the columns of regional strains",
                       columns_rule);
    std::vector<RegionStrain> strains;
    while (next_line()) {
      RegionStrain next = row();
      for (const RegionStrain& other : strains)
        if (other.region == next.region)
          throw InputError(lines_.where(), fmt::format("segment {} is there twice", next.region),
                           "Give one strain per segment");
      strains.push_back(std::move(next));
    }
    if (strains.empty())
      throw InputError(lines_.where(), "the file holds no strains", columns_rule);
    constexpr std::size_t many = 6;  // a few of an infarct may lengthen
    if (strains.size() >= many &&
        std::all_of(strains.begin(), strains.end(), [](const auto& s) { return s.strain > 0.0; }))
      throw InputError(lines_.where(),
                       fmt::format("all {} strains are positive: the muscle of the whole heart "
                                   "would lengthen while it contracts",
                                   strains.size()),
                       "Strain that shortens is negative; write it so");
    return strains;
  }

 private:
  [[nodiscard]] std::string join() const { return fmt::format("{}", fmt::join(fields_, ",")); }

  bool next_line() {
    if (!lines_.next())
      return false;
    fields_ = csv_fields(lines_.text());
    return true;
  }

  RegionStrain row() {
    if (fields_.size() != 3)
      throw InputError(lines_.where(), fmt::format("has {} values instead of 3", fields_.size()),
                       columns_rule);
    RegionStrain next = lower_case(fields_[0]) == "aha" ? aha_segment() : sector();
    next.strain = strain_in(fields_[2], measure_, lines_.where());
    if (next.cells.empty())
      throw InputError(lines_.where(),
                       fmt::format("the mesh has no element in segment {}", next.region),
                       "Leave the segment out, or take a finer mesh");
    return next;
  }

  RegionStrain aha_segment() {
    const auto number = number_of<int>(fields_[1]);
    if (!number || *number < 1 || *number > 17)
      throw InputError(lines_.where(), fmt::format("segment \"{}\" is not of 1 to 17", fields_[1]),
                       "The segments of the American Heart Association are numbered 1 to 17");
    RegionStrain next{fmt::format("{} {}", *number, mesh::aha_name(*number)), 0.0, {}};
    for (std::size_t c = 0; c < regions_.aha.size(); ++c)
      if (regions_.aha[c] == *number)
        next.cells.push_back(static_cast<int>(c));
    return next;
  }

  RegionStrain sector() {
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
    RegionStrain next{fmt::format("{} {}", *slice, *found), 0.0, {}};
    for (std::size_t c = 0; c < regions_.slice.size(); ++c)
      if (regions_.slice[c] == *slice && regions_.sector[c] == sector)
        next.cells.push_back(static_cast<int>(c));
    return next;
  }

  const mesh::Regions& regions_;
  Measure measure_;
  LineReader lines_;
  std::vector<std::string> fields_;
};

}  // namespace

std::vector<RegionStrain> read_region_strains(const std::string& file, Measure measure,
                                              const mesh::Regions& regions,
                                              const std::string& named_at) {
  return StrainFile(file, measure, regions, named_at).read();
}

}  // namespace lv::strain
