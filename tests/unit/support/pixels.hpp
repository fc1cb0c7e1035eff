#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lv::test {

/// What a reader of a PNG file sees.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> rgb;

  [[nodiscard]] std::map<std::uint32_t, int> counts() const;
};

[[nodiscard]] Pixels decoded(const std::string& png);

/// The bytes of the only PNG picture inside an SVG file.
[[nodiscard]] std::string embedded_png(const std::string& svg);

}  // namespace lv::test
