#include "lv/report/overlay.hpp"

#include "lv/report/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace lv::report {
namespace {

constexpr double tile = 200.0;  // points
constexpr double head = 18.0;

/// The pixels of an image that are shown.
struct Window {
  int left, top, columns, rows;
};

Window window(const Overlay& overlay) {
  constexpr double margin = 18.0;  // [mm]
  const image::Plane& plane = overlay.picture->plane;
  double left = plane.columns;
  double right = 0.0;
  double top = plane.rows;
  double bottom = 0.0;
  for (const OverlayLine& line : overlay.lines)
    for (const Vec3& x : line.points) {
      const Vec3 p = plane.pixel(x);
      left = std::min(left, p.x());
      right = std::max(right, p.x());
      top = std::min(top, p.y());
      bottom = std::max(bottom, p.y());
    }
  if (left > right)
    return {0, 0, plane.columns, plane.rows};
  const auto clamped = [](double x, int n) { return std::clamp(static_cast<int>(x), 0, n); };
  const int x0 = clamped(left - margin / plane.spacing_i, plane.columns - 1);
  const int y0 = clamped(top - margin / plane.spacing_j, plane.rows - 1);
  const int x1 = clamped(right + margin / plane.spacing_i + 1.0, plane.columns);
  const int y1 = clamped(bottom + margin / plane.spacing_j + 1.0, plane.rows);
  return {x0, y0, std::max(1, x1 - x0), std::max(1, y1 - y0)};
}

Image grey(const image::Picture& picture, const Window& w) {
  std::vector<float> sorted = picture.values;
  const auto bright = sorted.begin() + static_cast<std::ptrdiff_t>(0.99 * (sorted.size() - 1.0));
  std::nth_element(sorted.begin(), bright, sorted.end());
  const float high = *bright;
  const float low = *std::min_element(sorted.begin(), sorted.end());
  Image image{w.columns, w.rows, {}, picture.plane.spacing_i};
  for (int j = 0; j < w.rows; ++j)
    for (int i = 0; i < w.columns; ++i) {
      const float t = (picture.at(w.left + i, w.top + j) - low) / std::max(high - low, 1e-6F);
      const auto level =
          static_cast<std::uint32_t>(std::lround(255.0F * std::clamp(t, 0.0F, 1.0F)));
      image.argb.push_back(0xff000000U | level << 16U | level << 8U | level);
    }
  return image;
}

void draw(Canvas& canvas, const Overlay& overlay, const Point& corner) {
  const image::Plane& plane = overlay.picture->plane;
  const Window w = window(overlay);
  const double width = w.columns * plane.spacing_i;
  const double height = w.rows * plane.spacing_j;
  const double scale = tile / std::max(width, height);
  const Box box{corner.x, corner.y + head, scale * width, scale * height};
  canvas.text(overlay.title, {corner.x + 2.0, corner.y + 0.5 * head}, {.size = 9.0});
  canvas.image(grey(*overlay.picture, w), box);
  canvas.clipped(box, [&] {
    for (const OverlayLine& line : overlay.lines) {
      std::vector<Point> points;
      for (const Vec3& x : line.points) {
        const Vec3 p = plane.pixel(x);
        points.push_back({box.x + scale * plane.spacing_i * (p.x() + 0.5 - w.left),
                          box.y + scale * plane.spacing_j * (p.y() + 0.5 - w.top)});
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
