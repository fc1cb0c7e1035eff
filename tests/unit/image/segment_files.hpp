#pragma once

#include "lv/base/tensor.hpp"

#include "support/temporary_folder.hpp"
#include <fmt/format.h>
#include <matio.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

/// Files of Segment, made with the library of MATLAB's files.
namespace lv::test {

/// A field of a structure of MATLAB.
inline void set_field(matvar_t* structure, const char* name, std::vector<double> values,
                      std::vector<std::size_t> size) {
  matvar_t* field = Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE,
                                  static_cast<int>(size.size()), size.data(), values.data(), 0);
  Mat_VarAddStructField(structure, name);
  Mat_VarSetStructFieldByName(structure, name, 0, field);
}

/// Circles of the radius in 24 points x 2 times x 3 slices, in units of the voxels, none on the
/// last slice at the second time.
inline std::pair<std::vector<double>, std::vector<double>> circles(double radius) {
  std::vector<double> x;
  std::vector<double> y;
  for (int s = 0; s < 3; ++s)
    for (int t = 0; t < 2; ++t)
      for (int i = 0; i < 24; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 24;
        const bool none = s == 2 && t == 1;
        const double r = radius - 2.0 * t;
        x.push_back(none ? std::nan("") : 31.0 + r * std::cos(angle) / 1.5);
        y.push_back(none ? std::nan("") : 33.0 + r * std::sin(angle) / 1.25);
      }
  return {x, y};
}

/// A file of Segment as its library writes it.
inline std::string segment_bytes(const Mat3& axes, double rotated = 0.0) {
  const TemporaryFolder folder;
  std::array<std::size_t, 2> one{1, 1};
  matvar_t* set_struct = Mat_VarCreateStruct("setstruct", 2, one.data(), nullptr, 0);
  for (const auto& [name, radius] : {std::pair("Endo", 15.0), {"Epi", 24.0}}) {
    const auto [x, y] = circles(radius);
    set_field(set_struct, fmt::format("{}X", name).c_str(), x, {24, 2, 3});
    set_field(set_struct, fmt::format("{}Y", name).c_str(), y, {24, 2, 3});
  }
  const Vec3 r = axes.col(0);
  const Vec3 c = axes.col(1);
  set_field(set_struct, "ImageOrientation", {r.x(), r.y(), r.z(), c.x(), c.y(), c.z()}, {1, 6});
  set_field(set_struct, "ImagePosition", {10, -20, 30}, {1, 3});
  for (const auto& [name, value] : {std::pair("ResolutionX", 1.5),
                                    {"ResolutionY", 1.25},
                                    {"SliceThickness", 6.0},
                                    {"SliceGap", 2.0},
                                    {"Rotated", rotated},
                                    {"EDT", 1.0},
                                    {"EST", 2.0}})
    set_field(set_struct, name, {value}, {1, 1});
  mat_t* file = Mat_CreateVer((folder / "x.mat").c_str(), nullptr, MAT_FT_MAT5);
  Mat_VarWrite(file, set_struct, MAT_COMPRESSION_NONE);
  Mat_VarFree(set_struct);
  Mat_Close(file);
  return bytes_of(folder / "x.mat");
}

}  // namespace lv::test
