#pragma once

#include "lv/base/tensor.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// Surfaces of a ventricle as other programs write them.
namespace lv::test {

struct Bowl {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> faces;
};

/// The ellipsoid x^2/r^2 + y^2/r^2 + z^2/l^2 = 1 up to z = part l, open there or with a flat lid.
inline Bowl half_ellipsoid(double r, double l, double part, bool lid) {
  constexpr int around = 48;
  constexpr int rings = 40;
  Bowl bowl;
  bowl.points.emplace_back(0.0, 0.0, -l);
  const double top = std::acos(-part);
  for (int k = 1; k <= rings; ++k)
    for (int i = 0; i < around; ++i) {
      const double polar = top * k / rings;
      const double angle = 2.0 * M_PI * i / around;
      bowl.points.emplace_back(r * std::sin(polar) * std::cos(angle),
                               r * std::sin(polar) * std::sin(angle), -l * std::cos(polar));
    }
  const auto at = [](int k, int i) { return 1 + (k - 1) * around + i % around; };
  for (int i = 0; i < around; ++i)
    bowl.faces.push_back({0, at(1, i + 1), at(1, i)});
  for (int k = 1; k < rings; ++k)
    for (int i = 0; i < around; ++i) {
      bowl.faces.push_back({at(k, i), at(k, i + 1), at(k + 1, i)});
      bowl.faces.push_back({at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)});
    }
  if (!lid)
    return bowl;
  const int middle = static_cast<int>(bowl.points.size());
  bowl.points.emplace_back(0.0, 0.0, part * l);
  for (int i = 0; i < around; ++i)
    bowl.faces.push_back({middle, at(rings, i), at(rings, i + 1)});
  return bowl;
}

inline std::string obj_text(const Bowl& bowl) {
  std::string text;
  for (const Vec3& x : bowl.points)
    text += fmt::format("v {} {} {}\n", x.x(), x.y(), x.z());
  for (const auto& f : bowl.faces)
    text += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
  return text;
}

inline std::string stl_text(const Bowl& bowl) {
  std::string text = "solid bowl\n";
  for (const auto& f : bowl.faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int n : f)
      text += fmt::format("vertex {} {} {}\n", bowl.points[n].x(), bowl.points[n].y(),
                          bowl.points[n].z());
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid bowl\n";
}

inline std::string binary_stl(const Bowl& bowl) {
  std::string bytes(80, ' ');
  const auto add = [&](const auto& value) {
    std::array<char, sizeof value> raw{};
    std::memcpy(raw.data(), &value, sizeof value);
    bytes.append(raw.data(), raw.size());
  };
  add(static_cast<std::uint32_t>(bowl.faces.size()));
  for (const auto& f : bowl.faces) {
    for (int i = 0; i < 3; ++i)
      add(0.0F);
    for (const int n : f)
      for (int i = 0; i < 3; ++i)
        add(static_cast<float>(bowl.points[n][i]));
    add(std::uint16_t{0});
  }
  return bytes;
}

}  // namespace lv::test
