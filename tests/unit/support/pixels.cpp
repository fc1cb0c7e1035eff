#include "support/pixels.hpp"

#include <cairo.h>
#include <catch2/catch.hpp>

#include <cstring>
#include <memory>
#include <string_view>

namespace lv::test {

std::map<std::uint32_t, int> Pixels::counts() const {
  std::map<std::uint32_t, int> found;
  for (const auto pixel : rgb)
    ++found[pixel];
  return found;
}

Pixels decoded(const std::string& png) {
  std::string rest = png;
  const auto read = [](void* from, unsigned char* to, unsigned count) {
    auto& bytes = *static_cast<std::string*>(from);
    std::memcpy(to, bytes.data(), count);
    bytes.erase(0, count);
    return CAIRO_STATUS_SUCCESS;
  };
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_image_surface_create_from_png_stream(read, &rest), &cairo_surface_destroy);
  REQUIRE(cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS);
  Pixels p{cairo_image_surface_get_width(surface.get()),
           cairo_image_surface_get_height(surface.get()),
           {}};
  const auto* data = cairo_image_surface_get_data(surface.get());
  for (int y = 0; y < p.height; ++y) {
    const auto* row = data + y * cairo_image_surface_get_stride(surface.get());
    for (int x = 0; x < p.width; ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, row + 4 * x, 4);
      p.rgb.push_back(pixel & 0xffffffU);
    }
  }
  return p;
}

std::string embedded_png(const std::string& svg) {
  constexpr std::string_view before = "data:image/png;base64,";
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::size_t at = svg.find(before);
  REQUIRE(at != std::string::npos);
  std::string bytes;
  unsigned collected = 0;
  int bits = 0;
  for (at += before.size(); svg.at(at) != '"' && svg[at] != '='; ++at) {
    const std::size_t digit = digits.find(svg[at]);
    if (digit == std::string_view::npos)
      continue;  // the end of a line
    collected = (collected << 6U | static_cast<unsigned>(digit)) & 0xffffffU;
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes += static_cast<char>(collected >> static_cast<unsigned>(bits) & 255U);
    }
  }
  return bytes;
}

}  // namespace lv::test
