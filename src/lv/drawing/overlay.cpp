#include "lv/drawing/overlay.hpp"

#include "lv/base/table.hpp"
#include "lv/drawing/canvas.hpp"
#include "lv/drawing/picture_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lv::drawing {
namespace {

constexpr double tile = 200.0;  // points
constexpr double head = 18.0;

Image grey(const image::Picture& picture) {
  Image image{picture.plane.columns, picture.plane.rows, {}, picture.plane.spacing_i};
  for (const std::uint32_t level : grey_levels(picture))
    image.argb.push_back(0xff000000U | level << 16U | level << 8U | level);
  return image;
}

/// Where the letter stands in a box whose sides are those of the plane's image.
void draw_white_letter(Canvas& canvas, const Box& box, const image::Plane& plane,
                       const EdgeLetter& letter) {
  constexpr double least = 0.5;  // of a unit vector in the plane
  constexpr double inside = 9.0;
  const double across = letter.direction.dot(plane.along_row);
  const double down = letter.direction.dot(plane.along_column);
  if (std::hypot(across, down) < least)
    return;
  const double reach = std::min((0.5 * box.width - inside) / std::max(std::abs(across), 1e-9),
                                (0.5 * box.height - inside) / std::max(std::abs(down), 1e-9));
  canvas.text(letter.text,
              {box.x + 0.5 * box.width + reach * across, box.y + 0.5 * box.height + reach * down},
              {.size = 10.5, .align = Align::centre, .bold = true, .colour = white});
}

void draw_white_scale_bar(Canvas& canvas, const Box& box, double points_per_mm) {
  constexpr double length = 20.0;  // [mm]
  const double y = box.bottom() - 6.0;
  canvas.line({box.x + 6.0, y}, {box.x + 6.0 + length * points_per_mm, y}, {white, 2.0});
  canvas.text("20 mm", {box.x + 6.0, y - 8.0}, {.size = 8.0, .colour = white});
}

void draw(Canvas& canvas, const Overlay& overlay, const Point& corner) {
  std::vector<Vec3> all;
  for (const OverlayLine& line : overlay.lines)
    all.insert(all.end(), line.points.begin(), line.points.end());
  const image::Picture part = cut_around(*overlay.picture, all);
  const image::Plane& plane = part.plane;
  const double width = plane.columns * plane.spacing_i;
  const double height = plane.rows * plane.spacing_j;
  const double scale = tile / std::max(width, height);
  const Box box{corner.x, corner.y + head, scale * width, scale * height};
  canvas.text(overlay.title, {corner.x + 2.0, corner.y + 0.5 * head}, {.size = 9.0});
  canvas.image(grey(part), box);
  canvas.clipped(box, [&] {
    for (const OverlayLine& line : overlay.lines) {
      std::vector<Point> points;
      for (const Vec3& x : line.points) {
        const Vec3 p = plane.pixel(x);
        points.push_back({box.x + scale * plane.spacing_i * (p.x() + 0.5),
                          box.y + scale * plane.spacing_j * (p.y() + 0.5)});
      }
      const Pen pen{line.colour, 1.2, line.dashed};
      line.closed ? canvas.outline(points, pen) : canvas.line(points, pen);
    }
    draw_white_scale_bar(canvas, box, scale);
    for (const EdgeLetter& letter : overlay.letters)
      draw_white_letter(canvas, box, plane, letter);
  });
}

}  // namespace

void write_overlays(const std::vector<Overlay>& overlays, const std::string& footnote,
                    const std::filesystem::path& file) {
  constexpr double gap = 8.0;
  const int columns = std::clamp(static_cast<int>(overlays.size()), 1, 5);
  const int rows = (static_cast<int>(overlays.size()) + columns - 1) / columns;
  const double width = columns * (tile + gap) + gap;
  const double height = rows * (tile + head + gap) + gap + head;
  write_file(
      file, png(width, height, 1.5, [&](Canvas& canvas) {
        canvas.fill({0.0, 0.0, width, height}, white);
        for (int n = 0; n < static_cast<int>(overlays.size()); ++n) {
          const int column = n % columns;
          const int row = n / columns;
          draw(canvas, overlays[n], {gap + column * (tile + gap), row * (tile + head + gap)});
        }
        canvas.text(footnote, {gap, height - 0.5 * head - 2.0}, {.size = 9.0});
      }));
}

}  // namespace lv::drawing
