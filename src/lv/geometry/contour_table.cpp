#include "lv/geometry/contour_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lv::geometry {

Table contour_table(const std::vector<Contour>& contours, int decimals) {
  const bool said = std::any_of(contours.begin(), contours.end(),
                                [](const Contour& line) { return !line.drawn.how.empty(); });
  std::vector<std::string> columns{"slice", "contour", "point", "x_mm", "y_mm", "z_mm"};
  if (said)
    columns.insert(columns.end(), {"how", "by", "when"});
  Table table(std::move(columns));
  const auto coordinate = [&](double x) { return fmt::format("{:.{}f}", x, decimals); };
  for (const Contour& line : contours)
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      std::vector<std::string> row{std::to_string(line.slice),     name(line.side),
                                   std::to_string(i + 1),          coordinate(line.points[i].x()),
                                   coordinate(line.points[i].y()), coordinate(line.points[i].z())};
      if (said)
        row.insert(row.end(), {line.drawn.how, line.drawn.by, line.drawn.when});
      table.add_row(std::move(row));
    }
  return table;
}

}  // namespace lv::geometry
