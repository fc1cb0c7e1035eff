#pragma once

#include <initializer_list>
#include <optional>
#include <vector>

namespace lv::drawing {

/// sRGB, each part in [0, 1].
struct Colour {
  double r = 0.0;
  double g = 0.0;
  double b = 0.0;
};

[[nodiscard]] constexpr Colour hex(unsigned rgb) {
  return {((rgb >> 16U) & 255U) / 255.0, ((rgb >> 8U) & 255U) / 255.0, (rgb & 255U) / 255.0};
}

/// CIE lightness L*, 0 (black) to 100 (white).
[[nodiscard]] double lightness(const Colour& colour);

/// Colours of no value: missing data is drawn as stripes of these two greys.
inline constexpr Colour missing_ground = hex(0xd9d9d9);
inline constexpr Colour missing_stripe = hex(0x9a9a9a);

/// A continuous map from [0, 1] to colours through evenly spaced anchors. Between anchors it runs
/// straight in Oklab (B. Ottosson, 2020), where equal steps look equal.
class ColourMap {
 public:
  ColourMap(std::initializer_list<unsigned> anchors);

  /// The colour at t, which is clamped to [0, 1].
  [[nodiscard]] Colour operator()(double t) const;

 private:
  std::vector<Colour> table_;
};

/// Dark violet over teal to yellow; L* grows evenly from 20 to 92, so it survives a grey printer.
[[nodiscard]] ColourMap sequential();

/// Blue over light grey to red-brown, as far apart for colour-blind eyes as for others; L* is even
/// and the same on both sides of the middle.
[[nodiscard]] ColourMap diverging();

/// Eight colours after Okabe and Ito (2008) that colour-blind readers tell apart, then lighter
/// ones.
[[nodiscard]] Colour category(int index);

/// Of values that are as good as nothing.
inline constexpr Colour uncoloured = hex(0xeceae7);

/// Values to colours: `min` is the map's beginning, `max` its end. Values nearer than `floor` to
/// `middle` are as good as nothing and have no colour of the map; where the map begins at the
/// middle neither have those below it: between nodes, quadratic elements fall below what they have
/// there.
struct ColourScale {
  ColourMap map = sequential();
  double min = 0.0;
  double max = 1.0;
  double middle = 0.0;
  double floor = 0.0;

  /// Nothing when the value is missing (NaN).
  [[nodiscard]] std::optional<Colour> operator()(double value) const;

  /// Whether a value is as good as none, and has no colour of the map.
  [[nodiscard]] bool is_nothing(double value) const;

  /// How far along the map a value is: 0 at `min`, 1 at `max`, not beyond.
  [[nodiscard]] double place(double value) const;
};

}  // namespace lv::drawing
