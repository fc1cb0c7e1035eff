#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/case_file/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace lv::case_file {
namespace {

constexpr double largest_factor = 100.0;

/// Factors of segments, line by line.
class FactorFile {
 public:
  explicit FactorFile(const Case& c)
      : file_(beside(c, c.contractility_file).string()), lines_(file_) {
    if (!lines_.is_open())
      throw InputError(place_of(c, "muscle.contractility"),
                       fmt::format("{} cannot be opened: {}", file_, unreadable(file_)),
                       "Check the name; it is relative to the case file");
  }

  mesh::SegmentFactors read() {
    if (!lines_.next())
      refuse("the file holds no factors");
    const std::vector<std::string> columns = csv_fields(lines_.text());
    const std::size_t segment = place_of_column(columns, "segment");
    const std::size_t factor = place_of_column(columns, "factor");
    mesh::SegmentFactors factors = mesh::even_segments();
    std::set<int> seen;
    while (lines_.next()) {
      const std::vector<std::string> fields = csv_fields(lines_.text());
      if (fields.size() != columns.size())
        refuse(fmt::format("has {} values instead of {}", fields.size(), columns.size()));
      const auto number = number_of<int>(fields[segment]);
      if (!number || *number < 1 || *number > mesh::aha_count)
        refuse(fmt::format("segment \"{}\" is not of 1 to 17", fields[segment]));
      if (!seen.insert(*number).second)
        refuse(fmt::format("segment {} is there twice", *number));
      const auto value = number_of<double>(fields[factor]);
      if (!value || !(*value >= 0.0 && *value <= largest_factor))
        refuse(fmt::format("factor \"{}\" is no number from 0 to {:g}", fields[factor],
                           largest_factor));
      factors.at(*number - 1) = *value;
    }
    if (seen.empty())
      refuse("the file holds no factors");
    return factors;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(lines_.where(), what,
                     "The first line names the columns, of which segment (1 to 17 of the American "
                     "Heart Association) and factor are read; segments without a line have 1");
  }

  [[nodiscard]] std::size_t place_of_column(const std::vector<std::string>& columns,
                                            const std::string& name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end())
      refuse(fmt::format("there is no column {}", name));
    return static_cast<std::size_t>(found - columns.begin());
  }

  std::string file_;
  LineReader lines_;
};

}  // namespace

mesh::SegmentFactors segment_factors(const Case& c) {
  if (c.fitted_contractility)
    return *c.fitted_contractility;
  return c.contractility_file.empty() ? mesh::even_segments() : FactorFile(c).read();
}

}  // namespace lv::case_file
