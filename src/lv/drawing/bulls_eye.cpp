#include "lv/drawing/bulls_eye.hpp"

#include "lv/base/check.hpp"
#include "lv/drawing/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace lv::drawing {
namespace {

using std::numbers::pi;
const TextStyle wall_style{.size = 9.5, .align = Align::centre, .colour = hex(0x555555)};
const TextStyle territory_style{
    .size = 9.0, .align = Align::centre, .bold = true, .colour = hex(0x555555)};
const Pen parting{white, 1.2};  // between sectors
const Pen rim{ink, 4.5};        // of what is left of it parts territories

/// Part of a ring between two radii [points] and two angles, anticlockwise from the right.
struct Sector {
  double inner, outer, begin, end;

  [[nodiscard]] double middle_angle() const { return 0.5 * (begin + end); }
  [[nodiscard]] double middle_radius() const { return 0.5 * (inner + outer); }
  [[nodiscard]] bool is_disc() const { return inner == 0.0 && end - begin > 1.99 * pi; }
};

Point polar(const Point& centre, double radius, double angle) {
  return {centre.x + radius * std::cos(angle), centre.y - radius * std::sin(angle)};
}

void add_arc(std::vector<Point>& polygon, const Point& centre, double radius, const Range& angle) {
  const int steps = static_cast<int>(std::ceil(std::abs(angle.high - angle.low) * 60.0 / pi));
  for (int i = 0; i <= steps; ++i)
    polygon.push_back(polar(centre, radius, angle.low + (angle.high - angle.low) * i / steps));
}

std::vector<Point> polygon(const Sector& s, const Point& centre) {
  std::vector<Point> points;
  add_arc(points, centre, s.outer, {s.begin, s.end});
  if (!s.is_disc())
    add_arc(points, centre, s.inner, {s.end, s.begin});
  return points;
}

/// All sectors, ring after ring. A last ring of one sector fills the centre; otherwise the centre
/// stays empty, because sectors that meet in a point have no room for numbers.
std::vector<Sector> sectors(const std::vector<int>& counts, double radius) {
  const double hole = counts.back() == 1 ? 0.0 : 0.6;
  const double thickness = radius / (static_cast<double>(counts.size()) + hole);
  std::vector<Sector> result;
  double outer = radius;
  for (const int count : counts) {
    const double width = 2.0 * pi / count;
    const double inner = outer < 1.5 * thickness && hole == 0.0 ? 0.0 : outer - thickness;
    for (int i = 0; i < count; ++i) {
      const double begin = 0.5 * pi + (i - 0.5) * width;
      result.push_back({inner, outer, begin, begin + width});
    }
    outer = inner;
  }
  return result;
}

/// How numbers are set in all sectors alike: level where the widest fits into a ring, else along
/// the ring, and small enough for the shortest arc.
struct Numbers {
  std::vector<std::string> texts;
  double size = 9.5;
  bool along_ring = false;

  Numbers(Canvas& canvas, const BullsEye& plot, const std::vector<Sector>& parts) {
    const double thickness = parts.front().outer - parts.front().inner;
    double arc_fit = 1.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const bool is_shown = plot.decimals >= 0 && !std::isnan(plot.values[i]);
      texts.push_back(is_shown ? number(plot.values[i], plot.decimals) : "");
      const double width = std::max(1.0, canvas.text_width(texts.back(), {.size = size}));
      const double arc = parts[i].middle_radius() * (parts[i].end - parts[i].begin);
      along_ring = along_ring || width > 0.9 * thickness;
      arc_fit = std::min(arc_fit, 0.85 * arc / width);
    }
    size = std::min({size, 0.6 * thickness, size * arc_fit});
  }
};

/// The turn along the ring that does not put text on its head.
double turn_along_ring(const Sector& s) {
  return s.is_disc() ? 0.0 : std::remainder(s.middle_angle() - 0.5 * pi, pi);
}

void draw_walls(Canvas& canvas, const Point& centre, double radius, const BullsEye& plot) {
  for (int i = 0; i < 4; ++i) {
    TextStyle style = wall_style;
    style.turn = i % 2 == 1 ? upwards : 0.0;
    canvas.text(plot.walls[i], polar(centre, radius + 9.0, 0.5 * pi * (i + 1)), style);
  }
}

void draw_territory_names(Canvas& canvas, const Point& centre, double radius,
                          const BullsEye& plot) {
  for (const Territory& territory : plot.territories)
    canvas.text(territory.name, polar(centre, radius + 15.0, territory.angle), territory_style);
}

std::optional<Colour> colour_of(const BullsEye& plot, std::size_t i) {
  return plot.colours.empty() ? plot.scale(plot.values[i]) : plot.colours[i];
}

/// The sectors of each territory; all in one where there are no territories.
std::vector<std::vector<int>> groups(const BullsEye& plot) {
  std::vector<std::vector<int>> all;
  for (const Territory& territory : plot.territories)
    all.push_back(territory.sectors);
  if (all.empty()) {
    all.emplace_back(plot.values.size());
    std::iota(all.front().begin(), all.front().end(), 0);
  }
  return all;
}

void draw_sector(Canvas& canvas, const std::vector<Point>& shape,
                 const std::optional<Colour>& colour) {
  if (colour)
    canvas.fill(shape, *colour);
  else
    canvas.fill_missing(shape);
  canvas.outline(shape, parting);
}

/// Each territory lies in front of its own dark rim: what is left of it parts it from the others.
void draw_sectors(Canvas& canvas, const Point& centre, const std::vector<Sector>& parts,
                  const BullsEye& plot) {
  for (const std::vector<int>& group : groups(plot)) {
    if (!plot.territories.empty())
      for (const int i : group)
        canvas.outline(polygon(parts[i], centre), rim);
    for (const int i : group)
      draw_sector(canvas, polygon(parts[i], centre), colour_of(plot, i));
  }
}

/// The value of a sector, with its number above it where the plot has numbers.
void write_in(Canvas& canvas, const Point& centre, const Sector& sector, int number,
              const std::string& value, TextStyle style) {
  const Point at =
      polar(centre, sector.is_disc() ? 0.0 : sector.middle_radius(), sector.middle_angle());
  const auto above = [&](double distance) {
    return Point{at.x - distance * std::sin(style.turn), at.y - distance * std::cos(style.turn)};
  };
  const bool has_both = number > 0 && !value.empty();
  canvas.text(value, has_both ? above(-0.45 * style.size) : at, style);
  if (number == 0)
    return;
  const Point place = has_both ? above(0.75 * style.size) : at;
  style.size = std::min(style.size, 7.5);
  canvas.text(std::to_string(number), place, style);
}

}  // namespace

std::vector<int> seven_slices() {
  return {6, 6, 6, 6, 6, 4, 4};
}

std::vector<int> aha_17() {
  return {6, 6, 4, 1};
}

std::vector<Territory> coronary_territories() {
  return {{"LAD", {0, 1, 6, 7, 12, 13, 16}, pi / 3.0},
          {"RCA", {2, 3, 8, 9, 14}, 1.25 * pi},
          {"LCX", {4, 5, 10, 11, 15}, -pi / 6.0}};
}

bool has_missing(const BullsEye& plot) {
  return plot.colours.empty() && std::any_of(plot.values.begin(), plot.values.end(),
                                             [](double value) { return std::isnan(value); });
}

void draw(Canvas& canvas, const Box& box, const BullsEye& plot) {
  const double radius = 0.5 * std::min(box.width, box.height) - 16.0;
  const Point centre{box.x + 0.5 * box.width, box.y + 0.5 * box.height};
  const auto parts = sectors(plot.sectors, radius);
  LV_CHECK(plot.values.size() == parts.size());
  LV_CHECK(plot.colours.empty() || plot.colours.size() == parts.size());
  draw_sectors(canvas, centre, parts, plot);
  const Numbers numbers(canvas, plot, parts);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Colour ground = colour_of(plot, i).value_or(missing_ground);
    write_in(canvas, centre, parts[i], plot.is_numbered ? static_cast<int>(i) + 1 : 0,
             numbers.texts[i],
             {.size = numbers.size,
              .align = Align::centre,
              .turn = numbers.along_ring ? turn_along_ring(parts[i]) : 0.0,
              .colour = lightness(ground) > 55.0 ? ink : white});
  }
  draw_walls(canvas, centre, radius, plot);
  draw_territory_names(canvas, centre, radius, plot);
}

}  // namespace lv::drawing
