#pragma once

#include "lv/drawing/colour_map.hpp"
#include "lv/drawing/scene.hpp"

#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <vector>

struct _cairo;  // NOLINT(bugprone-reserved-identifier): cairo's own name; its header stays out of
                // ours

namespace lv::drawing {

/// A place on the page: points (1/72 inch) from the left and from the top.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

struct Box {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;

  [[nodiscard]] double right() const { return x + width; }
  [[nodiscard]] double bottom() const { return y + height; }
};

inline constexpr Colour ink = hex(0x1f1f1f);
inline constexpr Colour faint = hex(0xe6e6e6);
inline constexpr Colour white = hex(0xffffff);
inline constexpr double upwards = 0.5 * std::numbers::pi;  ///< the turn of text that reads upwards

struct Pen {
  Colour colour = ink;
  double width = 0.8;
  bool dashed = false;
};

enum class Align { left, centre, right };

struct TextStyle {
  double size = 10.0;
  Align align = Align::left;
  bool bold = false;
  double turn = 0.0;  ///< anticlockwise [rad]
  Colour colour = ink;
};

/// Draws on a page: the few operations that figures are made of.
class Canvas {
 public:
  /// Texts become elements in `svg_texts` if there are any, and shapes of letters otherwise.
  Canvas(_cairo* context, double pixels_per_point, std::string* svg_texts = nullptr);

  void line(std::span<const Point> points, const Pen& pen);
  void line(const Point& a, const Point& b, const Pen& pen);
  void outline(std::span<const Point> polygon, const Pen& pen);
  void fill(std::span<const Point> polygon, const Colour& colour);
  void fill(const Box& box, const Colour& colour);
  void disc(const Point& centre, double radius, const Colour& colour);
  /// The sign of a missing value: grey stripes.
  void fill_missing(std::span<const Point> polygon);
  /// A map from its beginning at the bottom to its end at the top.
  void gradient(const Box& box, const ColourMap& map);
  void image(const Image& image, const Box& box);
  /// `at` lies on half the height of the capitals, so that text is centred on its line.
  void text(const std::string& text, const Point& at, const TextStyle& style);
  [[nodiscard]] double text_width(const std::string& text, const TextStyle& style);
  /// Whatever `draw` does stays inside `box`.
  void clipped(const Box& box, const std::function<void()>& draw);

  [[nodiscard]] double pixels_per_point() const { return pixels_per_point_; }

 private:
  void set(const Colour& colour);
  void set(const TextStyle& style);
  void path(std::span<const Point> points);

  _cairo* cairo_;
  double pixels_per_point_;
  std::string* svg_texts_;
};

[[nodiscard]] std::vector<Point> corners(const Box& box);

/// A page of width x height points, drawn and returned as the bytes of a file.
using Draw = std::function<void(Canvas&)>;
[[nodiscard]] std::string png(double width, double height, double pixels_per_point,
                              const Draw& draw);
[[nodiscard]] std::string svg(double width, double height, double pixels_per_point,
                              const Draw& draw);

/// The bytes of a PNG of an image, transparent where nothing is drawn.
[[nodiscard]] std::string image_png(const Image& image);

/// The bytes of a PNG with 8 bits of grey a pixel, given row by row.
[[nodiscard]] std::string grey_png(int columns, int rows, const std::vector<unsigned char>& levels);

}  // namespace lv::drawing
