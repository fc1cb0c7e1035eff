#include "lv/geometry/contour_table.hpp"

#include <fmt/format.h>

namespace lv::geometry {

Table contour_table(const std::vector<Contour>& contours, int decimals) {
  Table table({"slice", "contour", "point", "x_mm", "y_mm", "z_mm"});
  const auto coordinate = [&](double x) { return fmt::format("{:.{}f}", x, decimals); };
  for (const Contour& line : contours)
    for (std::size_t i = 0; i < line.points.size(); ++i)
      table.add_row({std::to_string(line.slice), name(line.side), std::to_string(i + 1),
                     coordinate(line.points[i].x()), coordinate(line.points[i].y()),
                     coordinate(line.points[i].z())});
  return table;
}

}  // namespace lv::geometry
