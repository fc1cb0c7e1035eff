#include "lv/report/overlay.hpp"

#include "lv/report/canvas.hpp"
#include "lv/report/picture_files.hpp"

#include <algorithm>
#include <cstdint>

namespace lv::report {
namespace {

constexpr double tile = 200.0;  // points
constexpr double head = 18.0;

Image grey(const image::Picture& picture) {
  Image image{picture.plane.columns, picture.plane.rows, {}, picture.plane.spacing_i};
  for (const std::uint32_t level : grey_levels(picture))
    image.argb.push_back(0xff000000U | level << 16U | level << 8U | level);
  return image;
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
  write_whole(file, png(width, height, 1.5, [&](Canvas& canvas) {
                canvas.fill({0.0, 0.0, width, height}, white);
                for (int n = 0; n < static_cast<int>(overlays.size()); ++n)
                  draw(canvas, overlays[n],
                       {gap + (n % columns) * (tile + gap), (n / columns) * (tile + head + gap)});
                canvas.text(footnote, {gap, height - 0.5 * head - 2.0}, {.size = 9.0});
              }));
}

}  // namespace lv::report
