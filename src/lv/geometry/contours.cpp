#include "lv/geometry/contours.hpp"

#include "lv/base/check.hpp"
#include "lv/base/files.hpp"
#include "lv/base/lines.hpp"
#include "lv/geometry/contour_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace lv::geometry {
namespace {

/// The columns of a contour file; the first six are needed.
enum Column { slice, contour, point, x_mm, y_mm, z_mm, px_x, px_y, how, by, when, column_count };
constexpr std::array<std::string_view, column_count> column_names{
    "slice", "contour", "point", "x_mm", "y_mm", "z_mm", "px_x", "px_y", "how", "by", "when"};
constexpr int columns_needed = px_x;
constexpr const char* column_rule =
    "The first line names the columns slice,contour,point,x_mm,y_mm,z_mm (px_x, px_y, how, by "
    "and when may be there), separated by commas";

struct Row {
  int slice, point;
  Side side;
  Vec3 x;
  int line;
  Provenance drawn;
};

/// One contour file, read line by line.
class RowReader {
 public:
  explicit RowReader(const std::filesystem::path& path) : file_(path.string()), lines_(path) {
    if (!lines_.is_open())
      throw InputError(file_, "the contour file cannot be opened: " + unreadable(path),
                       "Check the name and that it can be read");
    read_header();
  }

  std::vector<Row> rows() {
    std::vector<Row> rows;
    while (lines_.next())
      rows.push_back(row());
    if (rows.empty())
      throw InputError(lines_.where(), "the contour file holds no points",
                       "Write one line per point after the line of column names");
    return rows;
  }

 private:
  void read_header() {
    if (!lines_.next())
      throw InputError(file_, "the contour file is empty", column_rule);
    const auto fields = csv_fields(lines_.text());
    width_ = fields.size();
    at_.fill(width_);
    for (std::size_t i = 0; i < width_; ++i) {
      const auto* found = std::find(column_names.begin(), column_names.end(), fields[i]);
      if (found == column_names.end())
        throw InputError(lines_.where(), fmt::format("unknown column \"{}\"", fields[i]),
                         column_rule);
      auto& at = at_[found - column_names.begin()];
      if (at != width_)
        throw InputError(lines_.where(), fmt::format("column \"{}\" appears twice", fields[i]),
                         column_rule);
      at = i;
    }
    for (int c = 0; c < columns_needed; ++c)
      if (at_[c] == width_)
        throw InputError(lines_.where(), fmt::format("column \"{}\" is missing", column_names[c]),
                         column_rule);
  }

  [[nodiscard]] Row row() const {
    const auto fields = csv_fields(lines_.text());
    if (fields.size() != width_)
      throw InputError(lines_.where(),
                       fmt::format("{} values in a table of {} columns", fields.size(), width_),
                       "Give every line one value per column");
    const auto field = [&](Column c) { return fields[at_[c]]; };
    return {whole_number(field(slice), "slice"),
            whole_number(field(point), "point"),
            side(field(contour)),
            {coordinate(field(x_mm), "x_mm"), coordinate(field(y_mm), "y_mm"),
             coordinate(field(z_mm), "z_mm")},
            lines_.number(),
            provenance(fields)};
  }

  [[nodiscard]] Provenance provenance(const std::vector<std::string>& fields) const {
    const auto said = [&](Column c) { return at_[c] == width_ ? std::string() : fields[at_[c]]; };
    Provenance drawn{said(how), said(by), said(when)};
    if (!drawn.how.empty() && drawn.how != "proposed" && drawn.how != "corrected" &&
        drawn.how != "drawn")
      throw InputError(lines_.where(), fmt::format("unknown way to draw \"{}\"", drawn.how),
                       "A contour is proposed, corrected or drawn; the column may be left out");
    return drawn;
  }

  [[nodiscard]] int whole_number(std::string_view text, const char* column) const {
    const auto value = number_of<int>(text);
    if (!value)
      throw InputError(lines_.where(), fmt::format("{} \"{}\" is not a whole number", column, text),
                       "Number slices and points 1, 2, 3 and so on");
    return *value;
  }

  [[nodiscard]] double coordinate(std::string_view text, const char* column) const {
    const auto value = number_of<double>(text);
    if (!value || !std::isfinite(*value))
      throw InputError(lines_.where(),
                       fmt::format("{} \"{}\" is not a finite number", column, text),
                       "Give the point's position in scanner millimetres or remove the line");
    return *value;
  }

  [[nodiscard]] Side side(std::string_view text) const {
    if (text == "endo")
      return Side::endo;
    if (text == "epi")
      return Side::epi;
    throw InputError(lines_.where(), fmt::format("unknown contour \"{}\"", text),
                     "A contour is endo (inner border of the muscle) or epi (outer border)");
  }

  std::string file_;
  LineReader lines_;
  std::size_t width_ = 0;
  std::array<std::size_t, column_count> at_{};  ///< position of each column; width_: not there
};

/// Puts a contour's points in the order of their numbers.
Contour in_order(std::vector<Row> rows, const std::string& file) {
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& p, const Row& q) { return p.point < q.point; });
  Contour c{rows.front().slice, rows.front().side, {}, file, {}, rows.front().drawn};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && rows[i].point == rows[i - 1].point)
      throw InputError(fmt::format("{}:{}", file, rows[i].line),
                       fmt::format("slice {}, {}, point {} is given a second time (first in line "
                                   "{})",
                                   c.slice, name(c.side), rows[i].point, rows[i - 1].line),
                       "Number the slices, and the points of each contour, once each");
    c.points.push_back(rows[i].x);
    c.lines.push_back(rows[i].line);
  }
  return c;
}

std::vector<Contour> read_file(const std::filesystem::path& path) {
  std::map<std::pair<int, Side>, std::vector<Row>> groups;
  for (const Row& row : RowReader(path).rows())
    groups[{row.slice, row.side}].push_back(row);
  std::vector<Contour> contours;
  for (auto& [key, rows] : groups)
    contours.push_back(in_order(std::move(rows), path.string()));
  return contours;
}

void append_apex_points(const std::filesystem::path& path, std::vector<Contour>& apex) {
  for (const Contour& c : read_file(path))
    for (std::size_t i = 0; i < c.points.size(); ++i)
      apex.push_back({c.slice, c.side, {c.points[i]}, c.file, {c.lines[i]}});
}

}  // namespace

const char* name(Side side) {
  return side == Side::endo ? "endo" : "epi";
}

std::string Contour::where(std::size_t point) const {
  return point < lines.size() ? fmt::format("{}:{}", file, lines[point]) : file;
}

const Contour* find(const std::vector<Contour>& contours, int slice, Side side) {
  const auto found = std::find_if(contours.begin(), contours.end(), [&](const Contour& c) {
    return c.slice == slice && c.side == side;
  });
  return found == contours.end() ? nullptr : &*found;
}

void drop_repeats(Contour& loop) {
  const auto repeats = [&](std::size_t i, std::size_t j) {
    return (loop.points[i] - loop.points[j]).norm() < 1e-6;
  };
  Contour kept = loop;
  kept.points.clear();
  kept.lines.clear();
  const std::size_t n = loop.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0 && (repeats(i, i - 1) || (i == n - 1 && repeats(i, 0))))
      continue;
    kept.points.push_back(loop.points[i]);
    if (i < loop.lines.size())
      kept.lines.push_back(loop.lines[i]);
  }
  loop = std::move(kept);
}

std::vector<Contour> read_curves(const std::filesystem::path& file) {
  return read_file(file);
}

Contours read_contours(const ContourFiles& files) {
  Contours contours;
  contours.short_axis = read_file(files.short_axis);
  for (Contour& loop : contours.short_axis)
    drop_repeats(loop);
  if (files.long_axis)
    contours.long_axis = read_curves(*files.long_axis);
  for (const auto& path : files.apex)
    append_apex_points(path, contours.apex);
  check_contours(contours);
  return contours;
}

}  // namespace lv::geometry
