#include "lv/strain/agreement.hpp"

#include "lv/base/check.hpp"
#include "lv/base/ending.hpp"
#include "lv/base/lines.hpp"
#include "lv/mesh/regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lv::strain {
namespace {

std::size_t column_of(const std::vector<std::string>& header, const std::string& name,
                      const std::string& where) {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end())
    throw InputError(where, fmt::format("has no column \"{}\"", name),
                     fmt::format("It has {}", fmt::join(header, ", ")));
  return static_cast<std::size_t>(found - header.begin());
}

double number_in(const std::string& text, const std::string& where) {
  const auto value = number_of<double>(text);
  if (!value || !std::isfinite(*value))
    throw InputError(where, why_no_number(text, "is not a finite number"),
                     "Give the number or remove the line");
  return *value;
}

int whole_number_in(const std::string& text, const std::string& where) {
  const double value = number_in(text, where);
  if (value != std::round(value) || std::abs(value) > 1e6)
    throw InputError(where, fmt::format("\"{}\" is not the number of a slice", text),
                     "Slices have whole numbers, 1 at the base");
  return static_cast<int>(value);
}

void check_segment(const std::string& segment, const std::string& where) {
  for (int sector = 1; sector <= 6; ++sector)
    if (segment == mesh::sector_name(1, sector))
      return;
  throw InputError(where, fmt::format("unknown segment \"{}\"", segment),
                   "The segments are Ant, AntSept, InfSept, Inf, InfLat and AntLat");
}

}  // namespace

Agreement agreement(const std::vector<Pair>& pairs) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  Agreement a;
  a.count = static_cast<int>(pairs.size());
  if (pairs.size() < 2) {
    a.bias = a.deviation = a.lower = a.upper = a.correlation = missing;
    return a;
  }
  const double n = a.count;
  double x = 0.0;
  double y = 0.0;
  for (const Pair& p : pairs) {
    x += p.measured / n;
    y += p.model / n;
  }
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  double squares = 0.0;
  a.bias = y - x;
  for (const Pair& p : pairs) {
    xx += (p.measured - x) * (p.measured - x);
    yy += (p.model - y) * (p.model - y);
    xy += (p.measured - x) * (p.model - y);
    squares += std::pow(p.model - p.measured - a.bias, 2);
  }
  a.deviation = std::sqrt(squares / (n - 1.0));
  a.lower = a.bias - 1.96 * a.deviation;
  a.upper = a.bias + 1.96 * a.deviation;
  a.correlation = xx * yy > 0.0 ? xy / std::sqrt(xx * yy) : missing;
  return a;
}

Table pairs_table(const std::vector<Pair>& pairs) {
  Table table({"scheme", "slice", "segment", "measured", "model", "difference"});
  for (const Pair& p : pairs)
    table.add_row({p.scheme, p.slice == 0 ? "" : std::to_string(p.slice), p.segment,
                   Table::number(p.measured, 5), Table::number(p.model, 5),
                   Table::number(p.model - p.measured, 5)});
  return table;
}

double strain_in(const std::string& text, Measure measure, const std::string& where) {
  constexpr double most = 2.0;
  const double least = measure == Measure::green_lagrange ? -0.5 : -1.0;
  const auto strain = number_of<double>(text);
  if (!strain || !(*strain > least) || !(*strain < most))
    throw InputError(
        where,
        fmt::format("strain \"{}\" is not a number above {:g} and below {:g}", text, least, most),
        "Strain is a fraction: -0.19 for 19% shortening");
  return *strain;
}

std::vector<Measured> read_measured(const std::filesystem::path& file, const std::string& column,
                                    Measure measure) {
  LineReader lines(file);
  if (!lines.is_open())
    throw InputError(file.string(), "cannot be read", "Check the path and its permissions");
  if (!lines.next())
    throw InputError(file.string(), "the table of strains is empty",
                     fmt::format("Give the columns slice, component, segment and {}", column));
  const std::vector<std::string> header = csv_fields(lines.text());
  const std::size_t slice = column_of(header, "slice", lines.where());
  const std::size_t component = column_of(header, "component", lines.where());
  const std::size_t segment = column_of(header, "segment", lines.where());
  const std::size_t value = column_of(header, column, lines.where());
  std::vector<Measured> measured;
  while (lines.next()) {
    const std::vector<std::string> fields = csv_fields(lines.text());
    const std::string where = lines.where();
    if (fields.size() != header.size())
      throw InputError(
          where, fmt::format("{} values in a table of {} columns", fields.size(), header.size()),
          "Give every line one value per column");
    Measured m{whole_number_in(fields[slice], where), lower_case(fields[component]),
               lower_case(fields[segment]), strain_in(fields[value], measure, where)};
    check_segment(m.segment, where);
    if (m.component != "cir" && m.component != "rad")
      throw InputError(where, fmt::format("unknown component \"{}\"", fields[component]),
                       "A component is cir (circumferential) or rad (radial)");
    for (const Measured& other : measured)
      if (other.slice == m.slice && other.component == m.component && other.segment == m.segment)
        throw InputError(where,
                         fmt::format("{} strain of slice {}, segment {}, is given twice",
                                     m.component, m.slice, m.segment),
                         "Keep one of the lines");
    measured.push_back(m);
  }
  if (measured.empty())
    throw InputError(file.string(), "has no line of strains",
                     "Give at least one line below the first");
  return measured;
}

}  // namespace lv::strain
