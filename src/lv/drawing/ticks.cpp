#include "lv/drawing/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace lv::drawing {
namespace {

constexpr double rounding = 1e-9;  // of a step: a limit that is a multiple up to rounding is one

double power_of_ten_below(double value) {
  return std::pow(10.0, std::floor(std::log10(value) + rounding));
}

/// The round number nearest, in ratio, to a quarter of the range.
double step(const Range& range) {
  const double ideal = 0.25 * (range.high - range.low);
  const double power = power_of_ten_below(ideal);
  const double ratio = ideal / power;
  return power * (ratio < std::sqrt(2.0)    ? 1.0
                  : ratio < std::sqrt(10.0) ? 2.0
                  : ratio < std::sqrt(50.0) ? 5.0
                                            : 10.0);
}

/// A range without extent gets one, so that constant data has an axis too.
Range with_extent(const Range& range) {
  if (range.high > range.low)
    return range;
  const double half = range.low == 0.0 ? 1.0 : 0.5 * std::abs(range.low);
  return {range.low - half, range.low + half};
}

std::string with_true_minus(std::string text) {
  for (auto at = text.find('-'); at != std::string::npos; at = text.find('-', at))
    text.replace(at, 1, "\u2212");
  return text;
}

/// a x 10^n, with the exponent in superscript digits.
std::string with_exponent(double value) {
  if (value == 0.0)
    return "0";
  static const std::array<std::string, 10> digits{"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                                  "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  const int n = static_cast<int>(std::floor(std::log10(std::abs(value)) + rounding));
  std::string text = with_true_minus(fmt::format("{:.3g}\u00d710", value / std::pow(10.0, n))) +
                     (n < 0 ? "\u207b" : "");
  for (const char digit : std::to_string(std::abs(n)))
    text += digits[digit - '0'];
  return text;
}

/// The multiples of d in a range. Large and tiny numbers get an exponent.
Ticks multiples(double d, const Range& range) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(d) + rounding)));
  const bool is_plain = decimals <= 4 && std::max(std::abs(range.low), std::abs(range.high)) < 1e6;
  const auto first = static_cast<std::int64_t>(std::ceil(range.low / d - rounding));
  const auto last = static_cast<std::int64_t>(std::floor(range.high / d + rounding));
  Ticks ticks{range, {}, {}};
  for (std::int64_t k = first; k <= last; ++k) {
    const double value = static_cast<double>(k) * d;
    ticks.values.push_back(value);
    ticks.labels.push_back(is_plain ? number(value, decimals) : with_exponent(value));
  }
  return ticks;
}

}  // namespace

double round_down(double value) {
  const double power = power_of_ten_below(value);
  for (const double factor : {5.0, 2.0})
    if (factor * power <= value * (1.0 + rounding))
      return factor * power;
  return power;
}

std::string number(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return with_true_minus(is_zero && text[0] == '-' ? text.substr(1) : text);
}

Ticks ticks_within(const Range& range) {
  const Range r = with_extent(range);
  return multiples(step(r), r);
}

}  // namespace lv::drawing
