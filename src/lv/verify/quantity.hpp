#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lv::verify {

/// One number that a problem checks. It passes when it lies within `tolerance` of `reference`.
struct Quantity {
  std::string problem;
  std::string quantity;
  double value = 0.0;
  double reference = 0.0;
  double tolerance = 0.0;  ///< in the quantity's unit
  std::string unit;        ///< empty: dimensionless

  /// False for a value that is not a number.
  [[nodiscard]] bool pass() const;
};

/// An aligned table for a terminal.
[[nodiscard]] std::string text_table(const std::vector<Quantity>& quantities);

/// One JSON object on one line; null for a number that is not finite.
[[nodiscard]] std::string json_line(const Quantity& quantity);

/// A file of quantities without loss of digits, and back. Reading a file that is absent gives none.
void write(const std::filesystem::path& file, const std::vector<Quantity>& quantities);
[[nodiscard]] std::vector<Quantity> read(const std::filesystem::path& file);

}  // namespace lv::verify
