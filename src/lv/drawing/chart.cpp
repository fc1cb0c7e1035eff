#include "lv/drawing/chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lv::drawing {
namespace {

constexpr double tick_length = 4.0;
constexpr double phase_line = 13.0;
const TextStyle tick_style{.size = 9.5};
const TextStyle label_style{.size = 10.5};
const TextStyle phase_style{.size = 9.0, .align = Align::centre, .colour = hex(0x555555)};

struct Scale {
  Ticks marks;
  double from, to;  ///< places of the range's ends on the page

  [[nodiscard]] double operator()(double value) const {
    const auto [low, high] = marks.range;
    return from + (value - low) / (high - low) * (to - from);
  }
};

Colour colour_of(const LineChart& chart, std::size_t i) {
  return chart.series[i].colour.value_or(category(static_cast<int>(i)));
}

void widen(Range& range, double value) {
  if (!std::isfinite(value))
    return;
  range.low = std::min(range.low, value);
  range.high = std::max(range.high, value);
}

/// A little more on both sides, so that no curve lies on the frame.
Range with_room(const Range& range) {
  const double room = range.low < range.high ? 0.04 * (range.high - range.low)
                                             : std::max(0.5 * std::abs(range.low), 0.5);
  return {range.low - room, range.high + room};
}

Ticks ticks_of(const Axis& axis, const std::vector<const std::vector<double>*>& data) {
  if (axis.range)
    return ticks_within(*axis.range);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Range range{infinity, -infinity};
  for (const auto* values : data)
    for (const double value : *values)
      widen(range, value);
  return range.low <= range.high ? ticks_within(with_room(range)) : ticks_within({});
}

enum class Direction { x, y, second_y };

Scale scale(const LineChart& chart, Direction direction) {
  std::vector<const std::vector<double>*> data;
  for (const Series& s : chart.series) {
    if (direction == Direction::x)
      data.push_back(&s.x);
    else if (s.on_second_axis == (direction == Direction::second_y))
      data.push_back(&s.y);
  }
  const Axis& axis = direction == Direction::x   ? chart.x
                     : direction == Direction::y ? chart.y
                                                 : chart.second_y;
  return {ticks_of(axis, data), 0.0, 1.0};
}

bool has_second_axis(const LineChart& chart) {
  return std::any_of(chart.series.begin(), chart.series.end(),
                     [](const Series& s) { return s.on_second_axis; });
}

double widest(Canvas& canvas, const Ticks& ticks) {
  double width = 0.0;
  for (const auto& label : ticks.labels)
    width = std::max(width, canvas.text_width(label, tick_style));
  return width;
}

/// Where the name of a phase is written: the middle of it, and the line above the plot.
struct PhaseName {
  double x;
  int line;
};

/// Names are centred on their phases but stay over the plot; each takes the first line that is
/// free.
std::vector<PhaseName> phase_names(Canvas& canvas, const Scale& x,
                                   const std::vector<Phase>& phases) {
  std::vector<PhaseName> names;
  std::vector<double> free_from;  // of each line
  for (const Phase& phase : phases) {
    const double half_width = 0.5 * canvas.text_width(phase.label, phase_style);
    const double left = x.from + half_width;
    const double at =
        std::clamp(0.5 * (x(phase.begin) + x(phase.end)), left, std::max(left, x.to - half_width));
    const auto line = std::find_if(free_from.begin(), free_from.end(),
                                   [&](double free) { return at - half_width >= free; });
    names.push_back({at, static_cast<int>(line - free_from.begin())});
    if (line == free_from.end())
      free_from.push_back(0.0);
    free_from[names.back().line] = at + half_width + 6.0;
  }
  return names;
}

/// The scales of a chart, the box between its axes, and what is written above it.
struct Frame {
  Scale x, y, second_y;
  Box plot;
  std::vector<PhaseName> phases;
};

Frame frame(Canvas& canvas, const Box& box, const LineChart& chart) {
  Frame f{scale(chart, Direction::x),
          scale(chart, Direction::y),
          scale(chart, Direction::second_y),
          box,
          {}};
  constexpr double label_height = 18.0;
  const double left = widest(canvas, f.y.marks) + tick_length + label_height + 4.0;
  const double right = has_second_axis(chart)
                           ? widest(canvas, f.second_y.marks) + tick_length + label_height + 4.0
                           : 0.5 * widest(canvas, f.x.marks);
  f.x.from = box.x + left;
  f.x.to = box.right() - right;
  f.phases = phase_names(canvas, f.x, chart.phases);
  double top = 6.0;
  for (const PhaseName& name : f.phases)
    top = std::max(top, (name.line + 1) * phase_line + 2.0);
  const double bottom = tick_length + 2.0 * label_height;
  f.plot = {box.x + left, box.y + top, box.width - left - right, box.height - top - bottom};
  f.y.from = f.second_y.from = f.plot.bottom();
  f.y.to = f.second_y.to = f.plot.y;
  return f;
}

void draw_phases(Canvas& canvas, const Frame& f, const LineChart& chart) {
  for (std::size_t i = 0; i < chart.phases.size(); ++i) {
    const Phase& phase = chart.phases[i];
    const double x0 = std::clamp(f.x(phase.begin), f.plot.x, f.plot.right());
    const double x1 = std::clamp(f.x(phase.end), f.plot.x, f.plot.right());
    canvas.fill({x0, f.plot.y, x1 - x0, f.plot.height}, hex(i % 2 == 0 ? 0xeef2f6 : 0xf9fafb));
    const auto& [x, line] = f.phases[i];
    canvas.text(phase.label, {x, f.plot.y - 2.0 - (line + 0.5) * phase_line}, phase_style);
  }
}

void draw_x_axis(Canvas& canvas, const Frame& f, const std::string& label) {
  const double y = f.plot.bottom();
  TextStyle style = tick_style;
  style.align = Align::centre;
  for (std::size_t i = 0; i < f.x.marks.values.size(); ++i) {
    const double x = f.x(f.x.marks.values[i]);
    canvas.line({x, y}, {x, y + tick_length}, {});
    canvas.text(f.x.marks.labels[i], {x, y + tick_length + 9.0}, style);
  }
  canvas.line({f.plot.x, y}, {f.plot.right(), y}, {});
  style = label_style;
  style.align = Align::centre;
  canvas.text(label, {f.plot.x + 0.5 * f.plot.width, y + tick_length + 26.0}, style);
}

/// `outwards` is -1 for the left axis and +1 for the right one.
void draw_y_axis(Canvas& canvas, const Frame& f, const Scale& y, const std::string& label,
                 double outwards) {
  const double x = outwards < 0.0 ? f.plot.x : f.plot.right();
  TextStyle style = tick_style;
  style.align = outwards < 0.0 ? Align::right : Align::left;
  for (std::size_t i = 0; i < y.marks.values.size(); ++i) {
    const double at = y(y.marks.values[i]);
    canvas.line({x, at}, {x + outwards * tick_length, at}, {});
    canvas.text(y.marks.labels[i], {x + outwards * (tick_length + 3.0), at}, style);
  }
  canvas.line({x, f.plot.y}, {x, f.plot.bottom()}, {});
  style = label_style;
  style.align = Align::centre;
  style.turn = upwards;
  const double away = tick_length + 3.0 + widest(canvas, y.marks) + 11.0;
  canvas.text(label, {x + outwards * away, f.plot.y + 0.5 * f.plot.height}, style);
}

void draw_marker(Canvas& canvas, Marker marker, const Point& at, const Colour& colour) {
  const double r = marker == Marker::circle ? 3.0 : 3.6;
  const int sides = marker == Marker::circle ? 24 : marker == Marker::square ? 4 : 3;
  const double turn = marker == Marker::square ? 0.25 * std::numbers::pi : 0.0;
  std::vector<Point> polygon;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides + turn;
    polygon.push_back({at.x + r * std::sin(angle), at.y - r * std::cos(angle)});
  }
  canvas.fill(polygon, colour);
  canvas.outline(polygon, {white, 0.7});
}

/// A curve as runs of points without a missing one between them.
std::vector<std::vector<Point>> runs(const Series& s, const Scale& x, const Scale& y) {
  std::vector<std::vector<Point>> result(1);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (std::isfinite(s.x[i]) && std::isfinite(s.y[i]))
      result.back().push_back({x(s.x[i]), y(s.y[i])});
    else if (!result.back().empty())
      result.emplace_back();
  }
  return result;
}

void draw_series(Canvas& canvas, const Frame& f, const Series& s, const Colour& colour) {
  for (const auto& run : runs(s, f.x, s.on_second_axis ? f.second_y : f.y)) {
    if (s.width > 0.0)
      canvas.line(run, {colour, s.width, s.dashed});
    if (s.marker != Marker::none)
      for (const Point& p : run)
        draw_marker(canvas, s.marker, p, colour);
    else if (run.size() == 1)  // between gaps: a line would not show
      canvas.disc(run.front(), s.width, colour);
  }
}

}  // namespace

std::vector<LegendEntry> legend(const LineChart& chart) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const Series& s = chart.series[i];
    const Colour colour = colour_of(chart, i);
    if (!s.label.empty())
      entries.push_back({s.label + (s.on_second_axis ? " (right)" : ""),
                         colour,
                         true,
                         {colour, s.width, s.dashed},
                         s.marker});
  }
  return entries;
}

void draw_sign(Canvas& canvas, const LegendEntry& entry, const Box& box) {
  if (!entry.is_line) {
    canvas.fill(box, entry.colour);
    return;
  }
  const double y = box.y + 0.5 * box.height;
  if (entry.pen.width > 0.0)
    canvas.line({box.x, y}, {box.right(), y}, entry.pen);
  if (entry.marker != Marker::none)
    draw_marker(canvas, entry.marker, {box.x + 0.5 * box.width, y}, entry.colour);
}

void draw(Canvas& canvas, const Box& box, const LineChart& chart) {
  const Frame f = frame(canvas, box, chart);
  draw_phases(canvas, f, chart);
  for (const double value : f.y.marks.values)
    canvas.line({f.plot.x, f.y(value)}, {f.plot.right(), f.y(value)}, {faint, 0.6});
  draw_x_axis(canvas, f, chart.x.label);
  draw_y_axis(canvas, f, f.y, chart.y.label, -1.0);
  if (has_second_axis(chart))
    draw_y_axis(canvas, f, f.second_y, chart.second_y.label, 1.0);
  constexpr double rim = 4.0;  // markers and thick lines on the frame stay whole
  canvas.clipped({f.plot.x - rim, f.plot.y - rim, f.plot.width + 2 * rim, f.plot.height + 2 * rim},
                 [&] {
                   for (std::size_t i = 0; i < chart.series.size(); ++i)
                     draw_series(canvas, f, chart.series[i], colour_of(chart, i));
                 });
}

}  // namespace lv::drawing
