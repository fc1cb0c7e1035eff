#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace lv::phantom {

/// Numbers that are the same wherever the program runs: the library's distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  /// In (0, 1).
  double uniform() { return (static_cast<double>(generator_() >> 11U) + 0.5) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Of variance 1, by the transformation of Box and Muller.
  double normal() {
    return std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace lv::phantom
