#pragma once

#include <span>
#include <string>

namespace lv {

/// The name most like `wanted` by the number of letters to change, insert or delete, upper and
/// lower case alike; empty if none is at all alike. For "did you mean".
[[nodiscard]] std::string nearest_name(const std::string& wanted,
                                       std::span<const std::string> names);

/// Which of the numbers, of which there are some, is nearest; the first of those equally near.
[[nodiscard]] std::size_t nearest_number(double wanted, std::span<const double> numbers);

}  // namespace lv
