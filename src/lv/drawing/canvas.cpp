#include "lv/drawing/canvas.hpp"

#include "lv/base/check.hpp"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string_view>

namespace lv::drawing {
namespace {

using SurfaceOwner = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using ContextOwner = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

SurfaceOwner own(cairo_surface_t* surface) {
  return {surface, &cairo_surface_destroy};
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(bytes)->append(data, data + length);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw RunError(std::string("a picture cannot be drawn: ") + cairo_status_to_string(status),
                   "Ask for a smaller picture");
}

SurfaceOwner surface_of(const Image& image) {
  SurfaceOwner surface =
      own(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height));
  require(cairo_surface_status(surface.get()));
  auto* bytes = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < image.height; ++y) {
    const auto* row = image.argb.data() + static_cast<std::ptrdiff_t>(y) * image.width;
    auto* to = reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::ptrdiff_t>(y) * stride);
    std::copy(row, row + image.width, to);
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

void draw_page(cairo_surface_t* surface, double pixels_per_point, const Draw& draw,
               std::string* svg_texts = nullptr) {
  const ContextOwner context(cairo_create(surface), &cairo_destroy);
  cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
  cairo_paint(context.get());
  Canvas canvas(context.get(), pixels_per_point, svg_texts);
  draw(canvas);
  require(cairo_status(context.get()));
}

/// FNV-1a (Fowler, Noll, Vo) of a text: the same everywhere.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text)
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

/// Cairo numbers the parts of its drawings through the life of a process. Numbered anew behind a
/// prefix, in the order in which they are named, they are the same in a process that draws the same
/// after other things.
std::string with_own_numbers(const std::string& svg, const std::string& prefix) {
  static constexpr std::array<std::string_view, 3> before{"id=\"", "href=\"#", "url(#"};
  const std::string_view all = svg;
  std::map<std::string_view, std::string> numbers;
  std::string text;
  for (std::size_t at = 0; at < all.size();) {
    const auto* marker = std::find_if(before.begin(), before.end(), [&](std::string_view word) {
      return all.substr(at, word.size()) == word;
    });
    if (marker == before.end()) {
      text += all[at++];
      continue;
    }
    const std::size_t first = at + marker->size();
    at = std::min(all.find_first_of("\")", first), all.size());
    text += *marker;
    text +=
        numbers
            .emplace(all.substr(first, at - first), fmt::format("{}{}", prefix, numbers.size() + 1))
            .first->second;
  }
  return text;
}

/// Ids that two figures share in no document: they bear the hash of their figure.
std::string with_own_ids(const std::string& svg) {
  const std::string numbered = with_own_numbers(svg, "part");
  return with_own_numbers(numbered, fmt::format("f{:016x}-", hash_of(numbered)));
}

/// Text inside an element.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text)
    safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return safe;
}

/// Text that can be searched and changed in the file; `down` is from the line's middle to the
/// baseline.
std::string text_element(const std::string& text, const Point& at, const TextStyle& style,
                         double down) {
  const Colour& c = style.colour;
  const auto percent = [](double part) { return 100.0 * part; };
  return fmt::format(
      "<text transform=\"translate({:.3f} {:.3f}) rotate({:.2f})\" y=\"{:.3f}\" "
      "font-family=\"DejaVu Sans, Verdana, sans-serif\" font-size=\"{:.2f}\"{} "
      "text-anchor=\"{}\" fill=\"rgb({:.1f}%,{:.1f}%,{:.1f}%)\">{}</text>\n",
      at.x, at.y, -style.turn * 180.0 / std::numbers::pi, down, style.size,
      style.bold ? " font-weight=\"bold\"" : "",
      style.align == Align::left     ? "start"
      : style.align == Align::centre ? "middle"
                                     : "end",
      percent(c.r), percent(c.g), percent(c.b), escaped(text));
}

}  // namespace

Canvas::Canvas(_cairo* context, double pixels_per_point, std::string* svg_texts)
    : cairo_(context), pixels_per_point_(pixels_per_point), svg_texts_(svg_texts) {
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
}

void Canvas::set(const Colour& colour) {
  cairo_set_source_rgb(cairo_, colour.r, colour.g, colour.b);
}

void Canvas::path(std::span<const Point> points) {
  cairo_new_path(cairo_);
  for (const Point& p : points)
    cairo_line_to(cairo_, p.x, p.y);
}

void Canvas::line(std::span<const Point> points, const Pen& pen) {
  path(points);
  set(pen.colour);
  cairo_set_line_width(cairo_, pen.width);
  const double dash = 3.5 * pen.width;
  cairo_set_dash(cairo_, &dash, pen.dashed ? 1 : 0, 0.0);
  cairo_stroke(cairo_);
}

void Canvas::line(const Point& a, const Point& b, const Pen& pen) {
  line(std::array{a, b}, pen);
}

void Canvas::outline(std::span<const Point> polygon, const Pen& pen) {
  std::vector<Point> closed(polygon.begin(), polygon.end());
  closed.insert(closed.end(), polygon.begin(), polygon.begin() + 2);  // joins the last corner too
  line(closed, pen);
}

void Canvas::fill(std::span<const Point> polygon, const Colour& colour) {
  path(polygon);
  set(colour);
  cairo_fill(cairo_);
}

void Canvas::fill(const Box& box, const Colour& colour) {
  fill(corners(box), colour);
}

void Canvas::disc(const Point& centre, double radius, const Colour& colour) {
  cairo_new_path(cairo_);
  cairo_arc(cairo_, centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  set(colour);
  cairo_fill(cairo_);
}

void Canvas::fill_missing(std::span<const Point> polygon) {
  fill(polygon, missing_ground);
  cairo_save(cairo_);
  path(polygon);
  cairo_clip_preserve(cairo_);
  Point low, high;
  cairo_path_extents(cairo_, &low.x, &low.y, &high.x, &high.y);
  // Stripes at multiples of their distance continue through neighbouring polygons.
  constexpr double distance = 4.0;
  const int first = static_cast<int>(std::floor((low.x + low.y) / distance));
  const int last = static_cast<int>(std::ceil((high.x + high.y) / distance));
  for (int k = first; k <= last; ++k)
    line({k * distance - low.y, low.y}, {k * distance - high.y, high.y}, {missing_stripe, 1.0});
  cairo_restore(cairo_);
}

void Canvas::gradient(const Box& box, const ColourMap& map) {
  constexpr int stops = 64;
  cairo_pattern_t* pattern = cairo_pattern_create_linear(0.0, box.bottom(), 0.0, box.y);
  for (int i = 0; i <= stops; ++i) {
    const double t = static_cast<double>(i) / stops;
    const Colour c = map(t);
    cairo_pattern_add_color_stop_rgb(pattern, t, c.r, c.g, c.b);
  }
  path(corners(box));
  cairo_set_source(cairo_, pattern);
  cairo_fill(cairo_);
  cairo_pattern_destroy(pattern);
}

void Canvas::image(const Image& image, const Box& box) {
  const SurfaceOwner surface = surface_of(image);
  cairo_save(cairo_);
  cairo_translate(cairo_, box.x, box.y);
  cairo_scale(cairo_, box.width / image.width, box.height / image.height);
  cairo_set_source_surface(cairo_, surface.get(), 0.0, 0.0);
  cairo_paint(cairo_);
  cairo_restore(cairo_);
}

void Canvas::set(const TextStyle& style) {
  cairo_select_font_face(cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_, style.size);
}

double Canvas::text_width(const std::string& text, const TextStyle& style) {
  set(style);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(const std::string& text, const Point& at, const TextStyle& style) {
  constexpr double half_capital = 0.364;  // of DejaVu Sans, in units of its size
  if (text.empty())
    return;
  if (svg_texts_ != nullptr) {
    *svg_texts_ += text_element(text, at, style, half_capital * style.size);
    return;
  }
  const double width = text_width(text, style);
  const double shift = style.align == Align::left     ? 0.0
                       : style.align == Align::centre ? -0.5 * width
                                                      : -width;
  cairo_save(cairo_);
  cairo_translate(cairo_, at.x, at.y);
  cairo_rotate(cairo_, -style.turn);
  set(style.colour);
  cairo_move_to(cairo_, shift, half_capital * style.size);
  cairo_show_text(cairo_, text.c_str());
  cairo_restore(cairo_);
}

void Canvas::clipped(const Box& box, const std::function<void()>& draw) {
  cairo_save(cairo_);
  path(corners(box));
  cairo_clip(cairo_);
  draw();
  cairo_restore(cairo_);
}

std::vector<Point> corners(const Box& box) {
  return {{box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}};
}

std::string png(double width, double height, double pixels_per_point, const Draw& draw) {
  const auto pixels = [&](double points) {
    return static_cast<int>(std::lround(points * pixels_per_point));
  };
  const SurfaceOwner surface =
      own(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(width), pixels(height)));
  cairo_surface_set_device_scale(surface.get(), pixels_per_point, pixels_per_point);
  draw_page(surface.get(), pixels_per_point, draw);
  std::string bytes;
  require(cairo_surface_write_to_png_stream(surface.get(), &append, &bytes));
  return bytes;
}

std::string image_png(const Image& image) {
  const SurfaceOwner surface = surface_of(image);
  std::string bytes;
  require(cairo_surface_write_to_png_stream(surface.get(), &append, &bytes));
  return bytes;
}

std::string svg(double width, double height, double pixels_per_point, const Draw& draw) {
  std::string bytes;
  const SurfaceOwner surface =
      own(cairo_svg_surface_create_for_stream(&append, &bytes, width, height));
  std::string texts;
  draw_page(surface.get(), pixels_per_point, draw, &texts);
  cairo_surface_finish(surface.get());
  require(cairo_surface_status(surface.get()));
  const std::size_t end = bytes.rfind("</svg>");
  LV_CHECK(end != std::string::npos);
  bytes.insert(end, texts);
  return with_own_ids(bytes);
}

std::string grey_png(int columns, int rows, const std::vector<unsigned char>& levels) {
  LV_CHECK(static_cast<std::ptrdiff_t>(levels.size()) ==
           static_cast<std::ptrdiff_t>(columns) * rows);
  const SurfaceOwner surface =
      own(cairo_image_surface_create(CAIRO_FORMAT_A8, columns, rows));  // A8 becomes grey in PNG
  require(cairo_surface_status(surface.get()));
  const int stride = cairo_image_surface_get_stride(surface.get());
  unsigned char* bytes = cairo_image_surface_get_data(surface.get());
  for (int j = 0; j < rows; ++j)
    std::copy_n(levels.begin() + static_cast<std::ptrdiff_t>(j) * columns, columns,
                bytes + static_cast<std::ptrdiff_t>(j) * stride);
  cairo_surface_mark_dirty(surface.get());
  std::string png;
  require(cairo_surface_write_to_png_stream(surface.get(), &append, &png));
  return png;
}

}  // namespace lv::drawing
