#include "lv/drawing/figure.hpp"

#include "lv/base/check.hpp"
#include "lv/base/table.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace lv::drawing {
namespace {

constexpr double margin = 12.0;
constexpr double gap = 22.0;  // between panels
constexpr double legend_line = 16.0;
constexpr double scale_strip = 20.0;
constexpr double bar_width = 11.0;
const TextStyle figure_title{.size = 13.0, .bold = true};
const TextStyle panel_title{.size = 11.5, .bold = true};
const TextStyle legend_style{.size = 9.5};
const TextStyle bar_ticks{.size = 9.5};
const TextStyle bar_label{.size = 10.5, .align = Align::centre, .turn = upwards};
constexpr double letter_height = 13.0;
const TextStyle letter_style{.size = 10.5, .align = Align::centre, .bold = true};
const TextStyle footnote_style{.size = 9.0, .colour = hex(0x555555)};

// ---- what panels ask for ----

bool has_missing(const Item& item) {
  const auto is_nan = [](double value) { return std::isnan(value); };
  if (const auto* points = std::get_if<PointValues>(&item.paint))
    return std::any_of(points->values.begin(), points->values.end(), is_nan);
  if (const auto* faces = std::get_if<FaceColours>(&item.paint))
    return std::any_of(faces->begin(), faces->end(), [](const auto& c) { return !c; });
  return false;
}

bool has_missing(const Panel& panel) {
  if (const auto* plot = std::get_if<BullsEye>(&panel.content))
    return has_missing(*plot);
  if (const auto* picture = std::get_if<Picture>(&panel.content)) {
    const auto& items = picture->scene.items;
    return std::any_of(items.begin(), items.end(), [](const Item& i) { return has_missing(i); });
  }
  return false;
}

std::vector<LegendEntry> entries(const Panel& panel) {
  std::vector<LegendEntry> all = panel.legend;
  if (const auto* chart = std::get_if<LineChart>(&panel.content)) {
    const auto own = legend(*chart);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

// ---- text that wraps ----

/// Where things of the given widths start when they are set in lines like words.
std::vector<Point> set_in_lines(const std::vector<double>& widths, double room, double line) {
  std::vector<Point> places;
  Point at;
  for (const double width : widths) {
    if (at.x > 0.0 && at.x + width > room)
      at = {0.0, at.y + line};
    places.push_back(at);
    at.x += width;
  }
  return places;
}

double sign_width(const LegendEntry& entry) {
  return entry.is_line ? 18.0 : 10.0;
}

std::vector<Point> legend_places(Canvas& canvas, const std::vector<LegendEntry>& entries,
                                 double room) {
  std::vector<double> widths;
  for (const auto& entry : entries)
    widths.push_back(sign_width(entry) + 18.0 + canvas.text_width(entry.label, legend_style));
  return set_in_lines(widths, room + 12.0, legend_line);
}

double legend_height(Canvas& canvas, const Panel& panel, double room) {
  const auto places = legend_places(canvas, entries(panel), room);
  return places.empty() ? 0.0 : places.back().y + legend_line;
}

void draw_legend(Canvas& canvas, const Panel& panel, const Box& box) {
  const auto all = entries(panel);
  const auto places = legend_places(canvas, all, box.width);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double x = box.x + places[i].x;
    const double y = box.y + places[i].y + 0.5 * legend_line;
    const double width = sign_width(all[i]);
    draw_sign(canvas, all[i], {x, y - 5.0, width, 10.0});
    canvas.text(all[i].label, {x + width + 5.0, y}, legend_style);
  }
}

std::vector<std::string> wrapped(Canvas& canvas, const std::string& text, double room,
                                 const TextStyle& style) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    if (lines.empty() || canvas.text_width(longer, style) > room)
      lines.push_back(word);
    else
      lines.back() = longer;
  }
  return lines;
}

// ---- colour bars ----

double bar_room(Canvas& canvas, const ColourBar& bar) {
  double labels = 0.0;
  for (const auto& label : ticks_within({bar.scale.min, bar.scale.max}).labels)
    labels = std::max(labels, canvas.text_width(label, bar_ticks));
  return 14.0 + bar_width + 7.0 + labels + 18.0;
}

/// `box` is the room that `bar_room` asked for.
void draw_bar(Canvas& canvas, const Box& box, const ColourBar& bar, bool with_missing) {
  const double height = std::min(0.8 * box.height, 260.0);
  const Box strip{box.x + 14.0, box.y + 0.5 * (box.height - height), bar_width, height};
  canvas.gradient(strip, bar.scale.map);
  const double from = bar.scale.place(bar.scale.middle - bar.scale.floor);
  const double to = bar.scale.place(bar.scale.middle + bar.scale.floor);
  if (to > from)
    canvas.fill(Box{strip.x, strip.bottom() - to * height, strip.width, (to - from) * height},
                uncoloured);
  canvas.outline(corners(strip), {ink, 0.6});
  const auto marks = ticks_within({bar.scale.min, bar.scale.max});
  for (std::size_t i = 0; i < marks.values.size(); ++i) {
    const double t = (marks.values[i] - marks.range.low) / (marks.range.high - marks.range.low);
    const double y = strip.bottom() - t * height;
    canvas.line({strip.right(), y}, {strip.right() + 3.0, y}, {});
    canvas.text(marks.labels[i], {strip.right() + 6.0, y}, bar_ticks);
  }
  canvas.text(bar.label, {box.right() - 7.0, strip.y + 0.5 * height}, bar_label);
  if (with_missing) {
    const Box swatch{strip.x, strip.bottom() + 8.0, bar_width, bar_width};
    canvas.fill_missing(corners(swatch));
    canvas.outline(corners(swatch), {ink, 0.6});
    canvas.text("missing", {swatch.right() + 6.0, swatch.y + 0.5 * bar_width}, bar_ticks);
  }
}

// ---- pictures ----

void draw_scale_bar(Canvas& canvas, const Box& box, double points_per_mm) {
  const double length = round_down(0.25 * box.width / points_per_mm);
  const double y = box.bottom() - 0.4 * scale_strip;
  const double end = box.x + length * points_per_mm;
  canvas.line({box.x, y}, {end, y}, {ink, 2.0});
  canvas.text(number(length, length < 1.0 ? 2 : 0) + " mm", {end + 6.0, y}, legend_style);
}

/// Letters on white ground; the farthest from the viewer first.
void draw_letters(Canvas& canvas, const Box& view, const Picture& picture) {
  std::vector<std::pair<Vec3, std::string>> letters;
  for (const Letter& letter : picture.letters)
    letters.emplace_back(seen(picture.camera, letter.at), letter.text);
  std::sort(letters.begin(), letters.end(),
            [](const auto& a, const auto& b) { return a.first.z() > b.first.z(); });
  const double scale = magnification(picture.camera, view.width, view.height);
  for (const auto& [x, text] : letters) {
    const Point at{view.x + 0.5 * view.width + scale * x.x(),
                   view.y + 0.5 * view.height + scale * x.y()};
    const double width = canvas.text_width(text, letter_style) + 4.0;
    canvas.fill({at.x - 0.5 * width, at.y - 0.5 * letter_height, width, letter_height}, white);
    canvas.text(text, at, letter_style);
  }
}

void draw(Canvas& canvas, const Box& box, const Picture& picture) {
  const double strip = picture.scale_bar ? scale_strip : 0.0;
  const Box view{box.x, box.y, box.width, box.height - strip};
  const auto pixels = [&](double points) {
    return std::max(1, static_cast<int>(std::lround(points * canvas.pixels_per_point())));
  };
  const Resolution resolution{.width = pixels(view.width),
                              .height = pixels(view.height),
                              .pixels_per_point = canvas.pixels_per_point()};
  canvas.image(render(picture.scene, picture.camera, resolution), view);
  draw_letters(canvas, view, picture);
  if (picture.scale_bar)
    draw_scale_bar(canvas, box, magnification(picture.camera, view.width, view.height));
}

// ---- the page ----

/// Heights above the content of panels, the same in a whole row so that contents stay aligned.
struct Heads {
  double title = 0.0;
  double legend = 0.0;

  [[nodiscard]] double height() const { return title + legend; }
};

void draw_panel(Canvas& canvas, const Box& box, const Panel& panel, const Heads& head) {
  canvas.text(panel.title, {box.x, box.y + 0.4 * head.title}, panel_title);
  draw_legend(canvas, panel, {box.x, box.y + head.title, box.width, head.legend});
  Box content{box.x, box.y + head.height(), box.width, box.height - head.height()};
  if (panel.colour_bar) {
    const double room = bar_room(canvas, *panel.colour_bar);
    content.width -= room;
    draw_bar(canvas, {content.right(), content.y, room, content.height}, *panel.colour_bar,
             has_missing(panel));
  }
  std::visit([&](const auto& part) { draw(canvas, content, part); }, panel.content);
}

/// Where everything goes, found with a canvas that measures text.
struct Layout {
  int columns = 1;
  std::vector<Heads> heads;  ///< of each row
  std::vector<double> tops;  ///< of each row
  double bottom = 0.0;       ///< of the last row
  double bar = 0.0;          ///< width that the common colour bar needs
  std::vector<std::string> footnote;
  double width = 0.0;
  double height = 0.0;

  static constexpr double title_height = 26.0;
  static constexpr double footnote_line = 13.0;

  Layout(Canvas& canvas, const Figure& figure) {
    const int count = static_cast<int>(figure.panels.size());
    columns = std::clamp(figure.columns, 1, std::max(1, count));
    heads.resize((count + columns - 1) / columns);
    for (int i = 0; i < count; ++i)
      make_room(canvas, figure.panels[i], figure.panel_width, heads[i / columns]);
    bottom = margin + (figure.title.empty() ? 0.0 : title_height) - gap;
    for (const Heads& head : heads) {
      tops.push_back(bottom + gap);
      bottom = tops.back() + head.height() + figure.panel_height;
    }
    bar = figure.colour_bar ? bar_room(canvas, *figure.colour_bar) : 0.0;
    width = 2.0 * margin + columns * (figure.panel_width + gap) - gap + bar;
    footnote = wrapped(canvas, figure.footnote, width - 2.0 * margin, footnote_style);
    height = bottom + footnote_line * static_cast<double>(footnote.size()) +
             (footnote.empty() ? margin : 1.7 * margin);
  }

  static void make_room(Canvas& canvas, const Panel& panel, double width, Heads& head) {
    head.title = std::max(head.title, panel.title.empty() ? 0.0 : 20.0);
    head.legend = std::max(head.legend, legend_height(canvas, panel, width));
  }
};

void draw_common_bar(Canvas& canvas, const Figure& figure, const Layout& page) {
  const bool missing = std::any_of(figure.panels.begin(), figure.panels.end(),
                                   [](const Panel& p) { return has_missing(p); });
  const double top = page.tops.front() + page.heads.front().height();
  draw_bar(canvas, {page.width - margin - page.bar, top, page.bar, page.bottom - top},
           *figure.colour_bar, missing);
}

void draw_figure(Canvas& canvas, const Figure& figure, const Layout& page) {
  canvas.text(figure.title, {margin, margin + 0.35 * Layout::title_height}, figure_title);
  for (int i = 0; i < static_cast<int>(figure.panels.size()); ++i) {
    const int row = i / page.columns;
    const int column = i % page.columns;
    const Box box{margin + column * (figure.panel_width + gap), page.tops[row], figure.panel_width,
                  page.heads[row].height() + figure.panel_height};
    draw_panel(canvas, box, figure.panels[i], page.heads[row]);
  }
  if (figure.colour_bar && !figure.panels.empty())
    draw_common_bar(canvas, figure, page);
  double y = page.bottom + 0.7 * margin + 0.5 * Layout::footnote_line;
  for (const auto& line : page.footnote) {
    canvas.text(line, {margin, y}, footnote_style);
    y += Layout::footnote_line;
  }
}

Layout layout(const Figure& figure) {
  std::optional<Layout> page;
  static_cast<void>(png(1.0, 1.0, 1.0, [&](Canvas& canvas) { page.emplace(canvas, figure); }));
  return *page;
}

}  // namespace

std::string png(const Figure& figure, double pixels_per_point) {
  const Layout page = layout(figure);
  return png(page.width, page.height, pixels_per_point,
             [&](Canvas& canvas) { draw_figure(canvas, figure, page); });
}

std::string svg(const Figure& figure, double pixels_per_point) {
  const Layout page = layout(figure);
  return svg(page.width, page.height, pixels_per_point,
             [&](Canvas& canvas) { draw_figure(canvas, figure, page); });
}

void write(const Figure& figure, const std::filesystem::path& file) {
  const auto kind = file.extension();
  LV_CHECK(kind == ".png" || kind == ".svg");
  write_file(file, kind == ".png" ? png(figure) : svg(figure));
}

}  // namespace lv::drawing
