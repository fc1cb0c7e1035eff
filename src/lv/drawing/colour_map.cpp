#include "lv/drawing/colour_map.hpp"

#include "lv/base/tensor.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace lv::drawing {
namespace {

constexpr int table_size = 256;

double to_linear(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double to_srgb(double c) {
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

/// Linear sRGB to cone responses, and their cube roots to Oklab.
const Mat3 cones{{0.4122214708, 0.5363325363, 0.0514459929},
                 {0.2119034982, 0.6806995451, 0.1073969566},
                 {0.0883024619, 0.2817188376, 0.6299787005}};
const Mat3 opponents{{0.2104542553, 0.7936177850, -0.0040720468},
                     {1.9779984951, -2.4285922050, 0.4505937099},
                     {0.0259040371, 0.7827717662, -0.8086757660}};

Vec3 to_oklab(const Colour& colour) {
  const Vec3 linear(to_linear(colour.r), to_linear(colour.g), to_linear(colour.b));
  return opponents * (cones * linear).unaryExpr([](double x) { return std::cbrt(x); });
}

Colour from_oklab(const Vec3& lab) {
  const Vec3 roots = opponents.inverse() * lab;
  const Vec3 linear = cones.inverse() * roots.cwiseProduct(roots).cwiseProduct(roots);
  const auto part = [&](int i) { return to_srgb(std::clamp(linear[i], 0.0, 1.0)); };
  return {part(0), part(1), part(2)};
}

}  // namespace

double lightness(const Colour& colour) {
  const double Y =
      0.2126 * to_linear(colour.r) + 0.7152 * to_linear(colour.g) + 0.0722 * to_linear(colour.b);
  return Y > 216.0 / 24389.0 ? 116.0 * std::cbrt(Y) - 16.0 : 24389.0 / 27.0 * Y;
}

ColourMap::ColourMap(std::initializer_list<unsigned> anchors) {
  std::vector<Vec3> lab;
  for (const unsigned anchor : anchors)
    lab.push_back(to_oklab(hex(anchor)));
  for (int i = 0; i < table_size; ++i) {
    const double at = i * (static_cast<double>(lab.size()) - 1.0) / (table_size - 1);
    const auto k = std::min(static_cast<std::size_t>(at), lab.size() - 2);
    const double w = at - static_cast<double>(k);
    table_.push_back(from_oklab((1.0 - w) * lab[k] + w * lab[k + 1]));
  }
}

Colour ColourMap::operator()(double t) const {
  return table_[std::lround(std::clamp(t, 0.0, 1.0) * (table_size - 1))];
}

ColourMap sequential() {
  return {0x441a68, 0x462f83, 0x41449b, 0x2c5da4, 0x1874a2, 0x028aa0,
          0x059f9b, 0x1eb490, 0x4ec77e, 0x87d763, 0xbee451, 0xf3ee44};
}

ColourMap diverging() {
  return {0x02468b, 0x2668aa, 0x4c8ac6, 0x7fadd6, 0xb6cfe4, 0xf1f1f1,
          0xe3c7b5, 0xd49c80, 0xc27152, 0xa8482e, 0x8b1a0f};
}

Colour category(int index) {
  constexpr std::array<unsigned, 8> colours{0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                            0xe69f00, 0x56b4e9, 0x4d4d4d, 0xf0e442};
  const int count = static_cast<int>(colours.size());
  const Colour pure = hex(colours[index % count]);
  const double w = std::pow(0.6, index / count);  // every further round of eight is lighter
  return {1.0 - w * (1.0 - pure.r), 1.0 - w * (1.0 - pure.g), 1.0 - w * (1.0 - pure.b)};
}

double ColourScale::place(double value) const {
  return max > min ? std::clamp((value - min) / (max - min), 0.0, 1.0) : 0.5;
}

std::optional<Colour> ColourScale::operator()(double value) const {
  if (std::isnan(value))
    return std::nullopt;
  return is_nothing(value) ? uncoloured : map(place(value));
}

bool ColourScale::is_nothing(double value) const {
  const double above = value - middle;
  return floor > 0.0 && (min < middle ? std::abs(above) : above) < floor;
}

}  // namespace lv::drawing
