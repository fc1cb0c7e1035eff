#pragma once

#include "lv/drawing/canvas.hpp"
#include "lv/drawing/ticks.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lv::drawing {

enum class Marker { none, circle, square, triangle };

/// A curve through points. A point with a missing number (NaN) interrupts the line.
struct Series {
  std::string label{};  ///< in the legend; empty: not listed
  std::vector<double> x{}, y{};
  std::optional<Colour> colour{};  ///< nothing: the next category
  double width = 1.8;              ///< [points]; 0: markers alone
  bool dashed = false;
  Marker marker = Marker::none;
  bool on_second_axis = false;
};

struct Axis {
  std::string label{};           ///< with its unit, e.g. "volume [ml]"
  std::optional<Range> range{};  ///< nothing: the data's, rounded out
};

/// A shaded stretch of the x axis.
struct Phase {
  std::string label{};
  double begin, end;
};

struct LineChart {
  Axis x{}, y{};
  Axis second_y{};  ///< on the right, for series that ask for it
  std::vector<Series> series{};
  std::vector<Phase> phases{};
};

/// How a legend shows an entry: a box of its colour, or a line and its marker.
struct LegendEntry {
  std::string label{};
  Colour colour;
  bool is_line = false;
  Pen pen{};
  Marker marker = Marker::none;
};

[[nodiscard]] std::vector<LegendEntry> legend(const LineChart& chart);
void draw_sign(Canvas& canvas, const LegendEntry& entry, const Box& box);

void draw(Canvas& canvas, const Box& box, const LineChart& chart);

}  // namespace lv::drawing
