#pragma once

#include <array>

namespace lv::test {

/// Steady isometric tension for T_scale = 1, computed independently, to eight digits.
struct SteadyReference {
  static constexpr std::array<double, 3> stretch{1.0, 1.1, 1.15};
  double Ca;                      ///< [uM]
  std::array<double, 3> tension;  ///< at those stretches [kPa]
};
inline constexpr std::array<SteadyReference, 8> steady_reference{
    {{0.1, {0.35678417, 0.96679215, 2.0002345}},
     {0.3, {3.7601574, 7.9136806, 13.945835}},
     {0.5, {7.5041466, 27.291408, 94.499892}},
     {0.8, {25.279085, 77.204844, 96.141158}},
     {1.0, {38.951924, 79.494066, 96.509983}},
     {1.5, {48.693344, 81.503421, 96.914661}},
     {3.0, {53.603063, 82.832244, 97.241596}},
     {10., {55.590341, 83.501592, 97.433249}}}};

}  // namespace lv::test
